#include "shaders/shader_program.h"

#include <cstdlib>
#include <cstring>

#include "scratch_folder.h"

namespace heightlight {
namespace {

/// "float", "vec3", "float3".
std::string type_name(int components, ShaderLanguage language) {
  if (components == 1) return "float";
  return (language == ShaderLanguage::hlsl ? "float" : "vec") + std::to_string(components);
}

/// A value, read from the sample's floats from `first` on.
std::string read_value(int components, int first, ShaderLanguage language) {
  std::string floats;
  for (int c = 0; c < components; ++c)
    floats += (c == 0 ? "" : ", ") + ("given[g + " + std::to_string(first + c) + "u]");
  return components == 1 ? floats : type_name(components, language) + '(' + floats + ')';
}

/// An array of the name that its input has, filled from the sample's floats from `first` on.
std::string read_array(const ShaderInput& input, int first, ShaderLanguage language) {
  std::string text = "  " + type_name(input.components, language) + ' ' + input.name + '[' +
                     std::to_string(input.elements) + "];\n";
  for (int i = 0; i < input.elements; ++i)
    text += "  " + input.name + '[' + std::to_string(i) +
            "] = " + read_value(input.components, first + i * input.components, language) + ";\n";
  return text;
}

/// One sample: i is its number.
std::string apply_to_sample(const ShaderFunction& function, ShaderLanguage language) {
  std::string arguments;
  std::string arrays;
  int floats = 0;
  for (const ShaderInput& input : function.inputs) {
    arguments += (arguments.empty() ? "" : ", ") +
                 (input.elements > 0 ? input.name : read_value(input.components, floats, language));
    if (input.elements > 0) arrays += read_array(input, floats, language);
    floats += float_count(input);
  }
  std::string text = "  uint g = i * " + std::to_string(floats) + "u;\n" + arrays + "  " +
                     type_name(function.components, language) + " value = " + function.name + '(' +
                     arguments + ");\n";
  for (int c = 0; c < function.components; ++c) {
    const std::string component = function.components == 1 ? "" : std::string(".") + "xyzw"[c];
    text += "  found[i * " + std::to_string(function.components) + "u + " + std::to_string(c) + "u] = value" +
            component + ";\n";
  }
  return text;
}

}  // namespace

bool has_command(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null").c_str()) == 0;
}

std::string program_text(const std::string& text, const ShaderFunction& function, ShaderLanguage language) {
  const std::string work = apply_to_sample(function, language);
  if (language == ShaderLanguage::hlsl)
    return "StructuredBuffer<float> given : register(t0);\nRWStructuredBuffer<float> found : "
           "register(u1);\n" +
           text + "[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {\n  uint i = id.x;\n" +
           work + "}\n";
  return "#version 450\nlayout(local_size_x = 64) in;\n"
         "layout(std430, binding = 0) readonly buffer Given { float given[]; };\n"
         "layout(std430, binding = 1) writeonly buffer Found { float found[]; };\n" +
         text + "void main() {\n  uint i = gl_GlobalInvocationID.x;\n" + work + "}\n";
}

std::vector<std::uint32_t> compile_program(const std::string& program, ShaderLanguage language,
                                           std::string& fault) {
  const ScratchFolder scratch;
  write_text(scratch / "program.comp", program);
  const std::string command = "cd '" + scratch.path().string() + "' && { glslangValidator " +
                              (language == ShaderLanguage::hlsl ? "-V -D -e main" : "-V") +
                              " -S comp -o program.spv program.comp && spirv-val program.spv; } > log 2>&1";
  if (std::system(command.c_str()) != 0) {
    fault = read_text(scratch / "log");
    return {};
  }
  const std::string bytes = read_text(scratch / "program.spv");
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

int input_floats(const ShaderFunction& function) {
  int floats = 0;
  for (const ShaderInput& input : function.inputs) floats += float_count(input);
  return floats;
}

}  // namespace heightlight
