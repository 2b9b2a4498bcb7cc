#include "shaders/shader_print.h"

#include <array>
#include <cassert>
#include <sstream>

namespace heightlight {
namespace {

/// What a language calls otherwise than GLSL and Godot do.
struct ShaderWord {
  const char* glsl;
  const char* hlsl;
  const char* wgsl;
};
constexpr std::array kShaderWords{
    ShaderWord{"float", "float", "f32"},
    ShaderWord{"vec2", "float2", "vec2<f32>"},
    ShaderWord{"vec3", "float3", "vec3<f32>"},
    ShaderWord{"vec4", "float4", "vec4<f32>"},
    ShaderWord{"mix", "lerp", "mix"},
    ShaderWord{"fract", "frac", "fract"},
    ShaderWord{"inversesqrt", "rsqrt", "inverseSqrt"},
};
constexpr std::size_t kTypeCount = 4;  ///< of the words above, the first

constexpr const char* kWordCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

std::string print_word(const std::string& word, ShaderLanguage language) {
  for (const ShaderWord& known : kShaderWords) {
    if (word != known.glsl) continue;
    return language == ShaderLanguage::hlsl   ? known.hlsl
           : language == ShaderLanguage::wgsl ? known.wgsl
                                              : known.glsl;
  }
  return word;
}

std::string print_words(const std::string& line, ShaderLanguage language) {
  std::string printed;
  for (std::size_t i = 0; i < line.size();) {
    const std::size_t begin = line.find_first_of(kWordCharacters, i);
    if (begin == std::string::npos) return printed + line.substr(i);
    const std::size_t end = std::min(line.find_first_not_of(kWordCharacters, begin), line.size());
    printed += line.substr(i, begin - i) + print_word(line.substr(begin, end - begin), language);
    i = end;
  }
  return printed;
}

/// "TYPE NAME" as WGSL has it, "NAME: TYPE".
std::string declare_in_wgsl(const std::string& declaration) {
  const std::size_t space = declaration.find(' ');
  assert(space != std::string::npos);
  return declaration.substr(space + 1) + ": " +
         print_word(declaration.substr(0, space), ShaderLanguage::wgsl);
}

/// "TYPE NAME(TYPE NAME, …) {" as WGSL has it.
std::string print_wgsl_head(const std::string& line) {
  const std::size_t space = line.find(' ');
  const std::size_t open = line.find('(');
  const std::size_t close = line.find(')');
  assert(space < open && open < close && close != std::string::npos);
  std::string arguments;
  for (std::size_t i = open + 1; i < close;) {
    const std::size_t end = std::min(line.find(", ", i), close);
    arguments += (arguments.empty() ? "" : ", ") + declare_in_wgsl(line.substr(i, end - i));
    i = end == close ? close : end + 2;
  }
  return "fn" + line.substr(space, open - space) + '(' + arguments + ") -> " +
         print_word(line.substr(0, space), ShaderLanguage::wgsl) + " {";
}

/// Declarations in WGSL begin with `let`, or are heads of functions.
std::string print_wgsl_line(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(' ');
  for (std::size_t i = 0; i < kTypeCount && begin != std::string::npos; ++i) {
    const std::string type = std::string(kShaderWords[i].glsl) + ' ';
    if (line.compare(begin, type.size(), type) != 0) continue;
    if (begin == 0) return print_wgsl_head(line);
    const std::size_t equals = line.find(" = ", begin);
    assert(equals != std::string::npos);
    return line.substr(0, begin) + "let " + declare_in_wgsl(line.substr(begin, equals - begin)) +
           print_words(line.substr(equals), ShaderLanguage::wgsl);
  }
  return print_words(line, ShaderLanguage::wgsl);
}

}  // namespace

std::string print_source(const std::string& text, ShaderLanguage language) {
  std::istringstream lines(text);
  std::string printed;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("//")) {
      printed += line;
    } else if (language == ShaderLanguage::wgsl) {
      printed += print_wgsl_line(line);
    } else {
      printed += print_words(line, language);
    }
    printed += '\n';
  }
  return printed;
}

ShaderFunction for_three_albedos(const ShaderFunction& function, ShaderLanguage language) {
  assert(function.is_per_channel && function.components == 1);
  constexpr std::size_t kChannels = 3;
  ShaderFunction three = function;
  const bool has_overloads = language == ShaderLanguage::glsl || language == ShaderLanguage::hlsl;
  if (!has_overloads) three.name += "_rgb";
  three.components = kChannels;
  three.inputs.back().components = kChannels;
  std::string declared;
  std::string passed;
  std::size_t before = 0;
  for (std::size_t i = 0; i + 1 < function.inputs.size(); ++i) {
    assert(function.inputs[i].components == 1);
    declared += "float " + function.inputs[i].name + ", ";
    passed += function.inputs[i].name + ", ";
    ++before;
  }
  const std::string albedo = function.inputs.back().name;
  const std::string call = function.name + '(' + passed + albedo;
  three.text = "vec3 " + three.name + '(' + declared + "vec3 " + albedo + ") {\n  return vec3(" + call +
               ".x), " + call + ".y), " + call + ".z));\n}\n";
  three.evaluate = [one = function.evaluate, before](const float* inputs, float* results) {
    std::vector<float> values(inputs, inputs + before + 1);
    for (std::size_t c = 0; c < kChannels; ++c) {
      values[before] = inputs[before + c];
      one(values.data(), results + c);
    }
  };
  return three;
}

}  // namespace heightlight
