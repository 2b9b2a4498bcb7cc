#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace heightlight {

/// What a formula may ask of a texel: A, alpha, n and rho.
enum class FormInput { sky_view_factor, ambient_occlusion, seen, albedo };

/// One value per FormInput, in that order.
using FormInputs = std::array<double, 4>;

/// One step of a formula in postfix order: it puts a value on a stack, or takes a function's arguments from
/// it and puts its value there.
struct ExpressionStep {
  enum class Kind { number, input, constant, function };
  Kind kind = Kind::number;
  double number = 0;      ///< of Kind::number
  std::size_t index = 0;  ///< of the input, the constant or the function
};

/// No formula has more steps; what evaluates one needs no deeper stack.
inline constexpr std::size_t kMostSteps = 200;

/// A formula as a user wrote it. Names are those of GLSL, and of HLSL where it has another; ^ raises to a
/// power. An own parser, since what is parsed must also become a shader: libraries that evaluate formulas
/// (muParser) keep their trees to themselves.
struct Expression {
  std::string text;
  std::vector<ExpressionStep> steps;
  std::vector<std::string> constants;  ///< free ones, in the order in which they come
};

/// Operators: + - * / ^ and parentheses, a sign before a value; ^ binds tightest, and from the right. Names:
/// A, alpha, n, rho (albedo), pi, and functions. A letter, alone or with digits behind it (k, c2), is a free
/// constant. The formula is what `text` holds from `begin` on. Throws UsageError with the column of what is
/// wrong: a character or a name that is not known, something missing, a function with too many or too few
/// arguments, more than kMostSteps steps or a nesting of more than some 50.
Expression parse_expression(const std::string& text, std::size_t begin = 0);

bool uses(const Expression& expression, FormInput input);

/// The formula's value, in double precision; NaN and infinities as IEEE 754 has them. `constants`: as many as
/// the expression has.
double evaluate(const Expression& expression, const FormInputs& inputs, std::span<const double> constants);

/// The formula for shaders, in the text that shaders.h prints in every language, with the constants in their
/// places; its inputs are variables A, alpha, n and rho, each in [0, 1]. It may call two functions of two
/// floats that no language has as C++ has them: heightlight_mod_in_NAME; and heightlight_power_in_NAME, where
/// the base may be negative or the exponent 0, of which shaders' pow is undefined.
std::string shader_expression(const Expression& expression, std::span<const double> constants,
                              const std::string& name);

}  // namespace heightlight
