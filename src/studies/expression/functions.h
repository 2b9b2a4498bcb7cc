#pragma once

#include <cstddef>
#include <span>

namespace heightlight {

/// How tightly what a shader's text holds is bound: what is bound looser than its place needs parentheses.
enum class Binding { sum, product, sign, whole };

/// A function or an operator of formulas.
struct FormulaFunction {
  const char* name;        ///< GLSL's; of an operator the character
  const char* other_name;  ///< HLSL's, likewise understood; nullptr where it is the same
  std::size_t arguments;
  double (*value)(const double* arguments);
  /// As shaders.h has it: $0, $1 … stand for the arguments, @ for the name of the form; nullptr of a
  /// power.
  const char* shader;
  Binding binding = Binding::whole;  ///< of the text
  Binding least = Binding::sum;      ///< of each argument's text; the last argument's is one tighter
};

/// All of them; the first six are the operators + - * / ^ and the sign.
std::span<const FormulaFunction> formula_functions();

inline constexpr std::size_t kPower = 4;
inline constexpr std::size_t kNegation = 5;

}  // namespace heightlight
