#include <array>

#include "expression/expression.h"
#include "expression/functions.h"
#include "forms/shader_literal.h"

namespace heightlight {
namespace {

constexpr std::array<const char*, 4> kInputNames{"A", "alpha", "n", "rho"};

/// A part of the text, and how tightly it is bound.
struct Part {
  std::string text;
  Binding binding;
};

Part number_part(double value) { return {shader_literal(value), value < 0 ? Binding::sign : Binding::whole}; }

std::string in_place(const Part& part, Binding least) {
  return part.binding < least ? "(" + part.text + ")" : part.text;
}

/// What an operator's operands are bound by at least; whole functions have commas between them.
Binding least_binding(const FormulaFunction& function, std::size_t argument) {
  if (function.binding == Binding::whole) return Binding::sum;
  const bool is_last_of_two = function.arguments == 2 && argument == 1;
  return is_last_of_two ? static_cast<Binding>(static_cast<int>(function.least) + 1) : function.least;
}

Part function_part(const FormulaFunction& function, ShaderLanguage language, const Part* arguments) {
  Part part{"", function.binding};
  for (const char* c = language == ShaderLanguage::glsl ? function.glsl : function.hlsl; *c; ++c) {
    if (*c != '$') {
      part.text += *c;
      continue;
    }
    const auto argument = static_cast<std::size_t>(*++c - '0');
    part.text += in_place(arguments[argument], least_binding(function, argument));
  }
  return part;
}

}  // namespace

std::string shader_expression(const Expression& expression, ShaderLanguage language,
                              std::span<const double> constants) {
  std::vector<Part> stack;
  for (const ExpressionStep& step : expression.steps) {
    switch (step.kind) {
      case ExpressionStep::Kind::number:
        stack.push_back(number_part(step.number));
        break;
      case ExpressionStep::Kind::input:
        stack.push_back({kInputNames.at(step.index), Binding::whole});
        break;
      case ExpressionStep::Kind::constant:
        stack.push_back(number_part(constants[step.index]));
        break;
      case ExpressionStep::Kind::function: {
        const FormulaFunction& function = formula_functions()[step.index];
        const std::size_t first = stack.size() - function.arguments;
        Part part = function_part(function, language, &stack[first]);
        stack.resize(first);
        stack.push_back(std::move(part));
        break;
      }
    }
  }
  return stack.front().text;
}

}  // namespace heightlight
