#include "shaders/shader_print.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <sstream>
#include <string_view>

namespace heightlight {
namespace {

/// A word that the languages spell differently; Godot's language spells it as GLSL does.
struct ShaderWord {
  const char* here;  ///< in the texts of the forms
  const char* glsl;
  const char* hlsl;
  const char* wgsl;
};
constexpr std::array kShaderWords{
    ShaderWord{"float", "float", "float", "f32"},
    ShaderWord{"vec2", "vec2", "float2", "vec2<f32>"},
    ShaderWord{"vec3", "vec3", "float3", "vec3<f32>"},
    ShaderWord{"vec4", "vec4", "float4", "vec4<f32>"},
    ShaderWord{"int", "int", "int", "i32"},
    ShaderWord{"mix", "mix", "lerp", "mix"},
    ShaderWord{"fract", "fract", "frac", "fract"},
    ShaderWord{"inversesqrt", "inversesqrt", "rsqrt", "inverseSqrt"},
    ShaderWord{"atan2", "atan", "atan2", "atan2"},
};
constexpr std::size_t kTypeCount = 5;  ///< the first of the words above are types

constexpr const char* kWordCharacters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

std::string print_word(const std::string& word, ShaderLanguage language) {
  for (const ShaderWord& known : kShaderWords) {
    if (word != known.here) continue;
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

bool is_type(const std::string& word) {
  return std::any_of(kShaderWords.begin(), kShaderWords.begin() + kTypeCount,
                     [&](const ShaderWord& type) { return word == type.here; });
}

/// "TYPE NAME" or "TYPE NAME[COUNT]", as WGSL writes it.
std::string declare_in_wgsl(const std::string& declaration) {
  const std::size_t space = declaration.find(' ');
  assert(space != std::string::npos);
  const std::string type = print_word(declaration.substr(0, space), ShaderLanguage::wgsl);
  const std::size_t bracket = declaration.find('[');
  if (bracket == std::string::npos) return declaration.substr(space + 1) + ": " + type;
  const std::string count = declaration.substr(bracket + 1, declaration.find(']') - bracket - 1);
  return declaration.substr(space + 1, bracket - space - 1) + ": array<" + type + ", " + count + '>';
}

/// "TYPE NAME(TYPE NAME, …) {", as WGSL writes it.
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

/// Whether a statement of the text assigns to a variable, apart from its declaration.
bool is_assigned(const std::string& text, const std::string& name) {
  for (const char* operation : {" = ", " += ", " -= ", " *= "}) {
    const std::string assignment = ' ' + name + operation;
    for (std::size_t at = text.find(assignment); at != std::string::npos;
         at = text.find(assignment, at + 1)) {
      const std::size_t before = text.find_last_not_of(kWordCharacters, at - 1) + 1;
      if (!is_type(text.substr(before, at - before))) return true;
    }
  }
  return false;
}

/// Prints a line of a text. A declaration is the head of a function; a variable, which WGSL declares with
/// `let` if it keeps its value; or the variable of a loop.
std::string print_wgsl_line(const std::string& line, const std::string& text) {
  constexpr std::string_view kLoop = "for (";
  std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const bool is_loop = line.compare(begin, kLoop.size(), kLoop) == 0;
  if (is_loop) begin += kLoop.size();
  const std::size_t space = line.find(' ', begin);
  if (space == std::string::npos || !is_type(line.substr(begin, space - begin)))
    return print_words(line, ShaderLanguage::wgsl);
  if (begin == 0) return print_wgsl_head(line);
  const std::size_t equals = line.find(" = ", begin);
  assert(equals != std::string::npos);
  const bool varies = is_loop || is_assigned(text, line.substr(space + 1, equals - space - 1));
  return line.substr(0, begin) + (varies ? "var " : "let ") +
         declare_in_wgsl(line.substr(begin, equals - begin)) +
         print_words(line.substr(equals), ShaderLanguage::wgsl);
}

}  // namespace

std::string print_source(const std::string& text, ShaderLanguage language) {
  std::istringstream lines(text);
  std::string printed;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("//")) {
      printed += line;
    } else if (language == ShaderLanguage::wgsl) {
      printed += print_wgsl_line(line, text);
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
  const std::string call = function.name + '(' + passed + "albedo.";
  three.inputs.back().name = "albedo";
  three.text = "vec3 " + three.name + '(' + declared + "vec3 albedo) {\n  return vec3(" + call + "x),\n    " +
               call + "y),\n    " + call + "z));\n}\n";
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
