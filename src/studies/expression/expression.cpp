#include "expression/expression.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "expression/functions.h"

namespace heightlight {
namespace {

using Kind = ExpressionStep::Kind;

}  // namespace

bool uses(const Expression& expression, FormInput input) {
  return std::any_of(expression.steps.begin(), expression.steps.end(), [input](const ExpressionStep& step) {
    return step.kind == Kind::input && step.index == static_cast<std::size_t>(input);
  });
}

double evaluate(const Expression& expression, const FormInputs& inputs, std::span<const double> constants) {
  assert(constants.size() == expression.constants.size());
  assert(expression.steps.size() <= kMostSteps);
  std::array<double, kMostSteps> stack;  // NOLINT(cppcoreguidelines-pro-type-member-init): steps write it
  std::size_t top = 0;
  for (const ExpressionStep& step : expression.steps) {
    switch (step.kind) {
      case Kind::number:
        stack[top++] = step.number;
        break;
      case Kind::input:
        stack[top++] = inputs[step.index];
        break;
      case Kind::constant:
        stack[top++] = constants[step.index];
        break;
      case Kind::function: {
        const FormulaFunction& function = formula_functions()[step.index];
        top -= function.arguments;
        stack[top] = function.value(&stack[top]);
        ++top;
        break;
      }
    }
  }
  assert(top == 1);
  return stack[0];
}

}  // namespace heightlight
