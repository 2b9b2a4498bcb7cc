#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "heightlight/forms.h"

// Formulas of this library as functions of shading languages. Each has one text, in the part of GLSL that all
// of the languages have under one name or another, from which it is printed in each:
//   * functions of `float`, `vec2`, `vec3`, `vec4` and arrays of them, their heads in one line that begins
//     without a space;
//   * a statement begins a line of its own: `TYPE NAME = …;` of one of these types or `int`, `NAME += …;`,
//     `return …;`, `if (…) { …; }`, `for (int NAME = …; …; …) {`, all bodies in braces;
//   * atan of two arguments is atan2; mix, fract and inversesqrt are GLSL's; no ?:, nothing else that a
//     language calls otherwise, no array but arguments, no argument that changes.

namespace heightlight {

enum class ShaderLanguage { glsl, hlsl, wgsl, godot };

struct ShaderLanguageName {
  ShaderLanguage language;
  const char* name;       ///< "glsl"
  const char* extension;  ///< of files: "glsl"
};

inline constexpr std::array<ShaderLanguageName, 4> kShaderLanguages{{
    {ShaderLanguage::glsl, "glsl", "glsl"},
    {ShaderLanguage::hlsl, "hlsl", "hlsl"},
    {ShaderLanguage::wgsl, "wgsl", "wgsl"},
    {ShaderLanguage::godot, "godot", "gdshaderinc"},
}};

/// An argument of a shader's function.
struct ShaderInput {
  std::string name;
  std::string meaning;
  int components = 1;  ///< of a vector, 1 for a float
  int elements = 0;    ///< of an array; 0 for none
  double low = 0;      ///< least and greatest value that makes sense
  double high = 1;
  bool is_clamped = true;  ///< what is outside is taken for the nearer end
  bool is_unit = false;    ///< a vector of length 1
  bool is_above = false;   ///< its z is not below 0
};

/// How many floats an argument is.
inline int float_count(const ShaderInput& input) {
  return input.components * (input.elements > 0 ? input.elements : 1);
}

/// One function that shaders get.
struct ShaderFunction {
  std::string name;     ///< as in the text
  std::string formula;  ///< or what it computes, in words
  std::string source;   ///< paper and equation; empty where it is this project's
  std::string error;    ///< as measured; empty for parts of other functions
  std::vector<ShaderInput> inputs;
  int components = 1;           ///< of what it returns
  bool is_per_channel = false;  ///< the last input is an albedo: it exists for albedos of three channels, too
  std::string text;             ///< as the head of this file says, without comments
  std::string twin;             ///< the C++ function that it equals
  /// That function in single precision: inputs one behind the other, components and all, to results.
  std::function<void(const float* inputs, float* results)> evaluate;
  /// The most by which the shader, executed by Mesa's lavapipe, may differ from its twin, in units of 2⁻²³,
  /// the last place of 1. Sums, products, quotients and roots are as exact there as in C++; powers,
  /// exponentials and trigonometric functions are not.
  double ulps = 1;
  /// The share of inputs that may differ by more, since the function jumps there and rounding decides the
  /// side.
  double jumps = 0;
};

/// Constants as fitted, to stand beside the published ones.
struct ShaderConstants {
  NotesConstants notes;
  CubicConstants cubic;
  SeenConstants seen;
};

/// Every function, with constants as published and as shipped, each behind those that it calls. A new one is
/// a line of this list.
const std::vector<ShaderFunction>& shader_functions();

/// The closed forms as published, and with constants as fitted: names end in _fitted, or, of this project's
/// own, have the fitted constants alone.
std::vector<ShaderFunction> fitted_shader_functions(const ShaderConstants& constants);

/// Functions as text of a language, with comments that say what they are; behind them those that are per
/// channel once more for three albedos (vec3, float3), under the same names where the language has functions
/// of one name for several types, under names that end in _rgb where it has not (WGSL, Godot).
std::string print_shader(const std::vector<ShaderFunction>& functions, ShaderLanguage language);

/// All functions in a file of a language: one, which a shader includes whole, since functions share parts
/// that must not come twice, and compilers leave out what is not called.
std::string shader_library(ShaderLanguage language);

/// How such a file begins, whatever wrote it.
std::string shader_library_mark();

/// The closed forms as functions to paste into a shader: print_shader of fitted_shader_functions and of one's
/// own. They compute what forms.h does, in the shader's precision.
std::string shader_text(ShaderLanguage language, const ShaderConstants& constants,
                        const std::vector<ShaderFunction>& own = {});

/// One of the closed forms, of the name that closed_forms() has for it, with what it is made from; for one
/// albedo and for three. Throws UsageError for a form that is its AO, or is none.
std::string form_shader(const std::string& name, ShaderLanguage language);

/// Functions of one's own, with what they call of the list.
std::string own_shader(const std::vector<ShaderFunction>& own, ShaderLanguage language);

/// The one function that a texture of the two channels A and n needs (kStoredPairShader), with its parts.
std::string stored_pair_shader(ShaderLanguage language);

/// Horizons that functions of the list take, four to a vector.
inline constexpr int kShaderHorizons = 16;

/// The functions of the list that find diffuse light of a sky that is not even, and what a glossy lobe sees
/// of an even one (occlusion_forms.h): from bent cones, or from so many stored horizons, 3 … 360.
std::string gloss_shader(ShaderLanguage language, int horizons = kShaderHorizons);

}  // namespace heightlight
