#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "expression/expression.h"
#include "expression/functions.h"
#include "shaders/shader_literal.h"

namespace heightlight {
namespace {

constexpr std::array<const char*, 4> kInputNames{"A", "alpha", "n", "rho"};

/// Between which values a part of the formula lies; what is not known is infinite.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

/// A part of the text, and how tightly it is bound.
struct Part {
  std::string text;
  Binding binding;
  Bounds bounds;
};

Part number_part(double value) {
  return {shader_literal(value), value < 0 ? Binding::sign : Binding::whole, {value, value}};
}

std::string in_place(const Part& part, Binding least) {
  return part.binding < least ? "(" + part.text + ")" : part.text;
}

/// What an operator's operands are bound by at least; whole functions have commas between them.
Binding least_binding(const FormulaFunction& function, std::size_t argument) {
  if (function.binding == Binding::whole) return Binding::sum;
  const bool is_last_of_two = function.arguments == 2 && argument == 1;
  return is_last_of_two ? static_cast<Binding>(static_cast<int>(function.least) + 1) : function.least;
}

Bounds product_bounds(const Bounds& a, const Bounds& b) {
  const double ends[] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  if (std::any_of(std::begin(ends), std::end(ends), [](double end) { return std::isnan(end); })) return {};
  return {*std::min_element(std::begin(ends), std::end(ends)),
          *std::max_element(std::begin(ends), std::end(ends))};
}

/// As far as bases of powers ask for it: of sums and products, and which functions are never negative.
Bounds function_bounds(const FormulaFunction& function, const Part* arguments) {
  const std::string_view called = function.name;
  const Bounds& a = arguments[0].bounds;
  if (function.arguments == 1 && called == "-") return {-a.high, -a.low};
  if (function.arguments == 2) {
    const Bounds& b = arguments[1].bounds;
    if (called == "+") return {a.low + b.low, a.high + b.high};
    if (called == "-") return {a.low - b.high, a.high - b.low};
    if (called == "*") return product_bounds(a, b);
    if (called == "/" && a.low >= 0 && b.low >= 0) return {.low = 0};
    if (function.shader == nullptr && a.low >= 0) return {.low = 0};  // a power
  }
  for (const char* never_negative : {"exp", "exp2", "sqrt", "inversesqrt", "abs", "fract", "saturate"}) {
    if (called == never_negative) return {.low = 0};
  }
  return {};
}

Part function_part(const FormulaFunction& function, const Part* arguments, const std::string& name) {
  const Bounds bounds = function_bounds(function, arguments);
  if (function.shader == nullptr) {
    const bool is_plain = arguments[0].bounds.low >= 0 && arguments[1].bounds.low > 0;
    return {(is_plain ? std::string("pow") : "heightlight_power_in_" + name) + '(' + arguments[0].text +
                ", " + arguments[1].text + ')',
            Binding::whole, bounds};
  }
  Part part{"", function.binding, bounds};
  for (const char* c = function.shader; *c; ++c) {
    if (*c != '$') {
      part.text += *c == '@' ? name : std::string(1, *c);
      continue;
    }
    const auto argument = static_cast<std::size_t>(*++c - '0');
    part.text += in_place(arguments[argument], least_binding(function, argument));
  }
  return part;
}

}  // namespace

std::string shader_expression(const Expression& expression, std::span<const double> constants,
                              const std::string& name) {
  std::vector<Part> stack;
  for (const ExpressionStep& step : expression.steps) {
    switch (step.kind) {
      case ExpressionStep::Kind::number:
        stack.push_back(number_part(step.number));
        break;
      case ExpressionStep::Kind::input:
        stack.push_back({kInputNames.at(step.index), Binding::whole, {0, 1}});
        break;
      case ExpressionStep::Kind::constant:
        stack.push_back(number_part(constants[step.index]));
        break;
      case ExpressionStep::Kind::function: {
        const FormulaFunction& function = formula_functions()[step.index];
        const std::size_t first = stack.size() - function.arguments;
        Part part = function_part(function, &stack[first], name);
        stack.resize(first);
        stack.push_back(std::move(part));
        break;
      }
    }
  }
  return stack.front().text;
}

}  // namespace heightlight
