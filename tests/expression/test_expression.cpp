#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "expression/expression.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

using Catch::Contains;

constexpr FormInputs kHere{0.3, 0.4, 0.6, 0.8};  ///< A, alpha, n, rho

double value(const std::string& text, const std::vector<double>& constants = {}) {
  return evaluate(parse_expression(text), kHere, constants);
}

std::string glsl(const std::string& text, const std::vector<double>& constants = {}) {
  return shader_expression(parse_expression(text), constants, "mine");
}

}  // namespace

TEST_CASE("formulas mean what they would in mathematics", "[forms][expression]") {
  CHECK(value("1 - 2 - 3") == -4);
  CHECK(value("8/4/2") == 1);
  CHECK(value("2 + 3*4^2") == 50);
  CHECK(value("2^3^2") == 512);
  CHECK(value("-2^2") == -4);
  CHECK(value("2^-1") == 0.5);
  CHECK(value("2*-3") == -6);
  CHECK(value("- -3") == 3);
  CHECK(value("+3") == 3);
  CHECK(value(" ( 1+1 ) * 3 ") == 6);
  CHECK(value("1.5e1") == 15);
  CHECK(value(".5f") == 0.5);
  CHECK(value("A") == 0.3);
  CHECK(value("alpha") == 0.4);
  CHECK(value("n") == 0.6);
  CHECK(value("rho + albedo") == 1.6);
  CHECK(value("cos(pi)") == -1);
  CHECK(value("A/(1 - rho*(1 - A)^k)", {1}) == 0.3 / (1 - 0.8 * std::pow(0.7, 1)));
  CHECK(std::isinf(value("1/(A - A)")));
  CHECK(std::isnan(value("sqrt(-A)")));
}

TEST_CASE("functions are those of shading languages, by either of their names", "[forms][expression]") {
  CHECK(value("pow(2, 5)") == 32);
  CHECK(value("exp(1)") == std::exp(1.0));
  CHECK(value("exp2(3)") == 8);
  CHECK(value("log(exp(2))") == Approx(2));
  CHECK(value("log2(8)") == 3);
  CHECK(value("inversesqrt(4)") == 0.5);
  CHECK(value("rsqrt(4)") == 0.5);
  CHECK(value("abs(-2) + sign(-2) + floor(-0.5) + ceil(0.5)") == 1);
  CHECK(value("fract(-0.25)") == 0.75);
  CHECK(value("frac(1.25)") == 0.25);
  CHECK(value("mod(-1, 3)") == 2);  // GLSL's; fmod of C and HLSL says −1
  CHECK(value("min(1, 2) + max(1, 2)") == 3);
  CHECK(value("clamp(5, 0, 2)") == 2);
  CHECK(value("saturate(-1) + saturate(0.5) + saturate(2)") == 1.5);
  CHECK(value("mix(2, 4, 0.25)") == 2.5);
  CHECK(value("lerp(2, 4, 0.25)") == 2.5);
  CHECK(value("step(0.5, 0.4) + step(0.5, 0.5)") == 1);
  CHECK(value("smoothstep(0, 1, 0.25)") == 0.15625);
  CHECK(value("sin(0) + tan(0) + asin(0) + acos(1) + atan(0)") == 0);
}

TEST_CASE("letters are constants, in the order in which they come", "[forms][expression]") {
  const Expression expression = parse_expression("k*A + c2^k - B");
  CHECK((expression.constants == std::vector<std::string>{"k", "c2", "B"}));
  CHECK(evaluate(expression, kHere, std::vector<double>{2, 3, 4}) == 2 * 0.3 + 9 - 4);
  CHECK(uses(expression, FormInput::sky_view_factor));
  CHECK_FALSE(uses(expression, FormInput::seen));
}

TEST_CASE("what is wrong with a formula is named, with its column", "[forms][expression]") {
  const auto fault = [](const std::string& text) {
    try {
      parse_expression(text);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  CHECK_THAT(fault(""), Contains("column 1") && Contains("ends where a value must stand"));
  CHECK_THAT(fault("A +"), Contains("column 4") && Contains("ends"));
  CHECK_THAT(fault("(A"), Contains("a ')' is missing"));
  CHECK_THAT(fault("A)"), Contains("column 2") && Contains("')' is not expected"));
  CHECK_THAT(fault("foo(A)"), Contains("column 1") && Contains("no function 'foo'"));
  CHECK_THAT(fault("1 + alhpa"), Contains("column 5") && Contains("'alhpa' is not known"));
  CHECK_THAT(fault("mix(A, 1)"), Contains("mix takes 3 arguments, not 2"));
  CHECK_THAT(fault("exp"), Contains("'exp' is a function"));
  CHECK_THAT(fault("2A"), Contains("an operator is missing"));
  CHECK_THAT(fault("1.2.3"), Contains("an operator is missing"));
  CHECK_THAT(fault("A ? 1 : 2"), Contains("'?' is not expected"));
  CHECK_THAT(fault("A\nB"), Contains("column 2"));
  CHECK_THAT(fault(std::string(60, '(') + "A"), Contains("nested too deeply"));
  CHECK_THAT(fault(std::string(500, '-') + "A"), Contains("nested too deeply"));
  std::string long_sum = "A";
  for (int i = 0; i < 200; ++i) long_sum += "+A";
  CHECK_THAT(fault(long_sum), Contains("more than 200 steps"));
}

TEST_CASE("shaders get as many parentheses as the formula needs", "[forms][expression]") {
  CHECK(glsl("1 - (2 - 3)") == "1.0 - (2.0 - 3.0)");
  CHECK(glsl("(1 - 2) - 3") == "1.0 - 2.0 - 3.0");
  CHECK(glsl("A/(n*rho)") == "A / (n * rho)");
  CHECK(glsl("(A + n)*rho") == "(A + n) * rho");
  CHECK(glsl("-(A + n)") == "-(A + n)");
  CHECK(glsl("-A^2") == "-pow(A, 2.0)");
  CHECK(glsl("(-A)^2") == "heightlight_power_in_mine(-A, 2.0)");
  CHECK(glsl("(1 - A)^2") == "pow(1.0 - A, 2.0)");
  CHECK(glsl("(1 - rho*(1 - A))^0.5") == "pow(1.0 - rho * (1.0 - A), 0.5)");
  CHECK(glsl("(A - n)^3") == "heightlight_power_in_mine(A - n, 3.0)");
  CHECK(glsl("A^rho") == "heightlight_power_in_mine(A, rho)");
  CHECK(glsl("A^(rho + 1)") == "pow(A, rho + 1.0)");
  CHECK(glsl("A - k*n", {-2}) == "A - -2.0 * n");
  CHECK(glsl("k^2", {-2}) == "heightlight_power_in_mine(-2.0, 2.0)");
  CHECK(glsl("- -A") == "-(-A)");
  CHECK(glsl("-k*A", {-2}) == "-(-2.0) * A");
  CHECK(glsl("mix(A, n, rsqrt(4))") == "mix(A, n, inversesqrt(4.0))");
  CHECK(glsl("lerp(frac(A), n, mod(A + 1, 2))") == "mix(fract(A), n, heightlight_mod_in_mine(A + 1.0, 2.0))");
}

}  // namespace heightlight
