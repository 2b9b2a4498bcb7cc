#include "expression/functions.h"

#include <algorithm>
#include <cmath>

namespace heightlight {
namespace {

constexpr FormulaFunction same(const char* name, std::size_t arguments, double (*value)(const double*),
                               const char* text) {
  return {name, nullptr, arguments, value, text};
}

constexpr FormulaFunction infix(const char* name, double (*value)(const double*), const char* text,
                                Binding binding) {
  return {name, nullptr, 2, value, text, binding, binding};
}

double clamp_value(double x, double low, double high) { return std::min(std::max(x, low), high); }

double step_smoothly(const double* x) {
  const double t = clamp_value((x[2] - x[0]) / (x[1] - x[0]), 0, 1);
  return t * t * (3 - 2 * t);
}

/// By GLSL's definitions (GLSL 4.60, chapter 8).
constexpr FormulaFunction kFunctions[] = {
    infix(
        "+", [](const double* x) { return x[0] + x[1]; }, "$0 + $1", Binding::sum),
    infix(
        "-", [](const double* x) { return x[0] - x[1]; }, "$0 - $1", Binding::sum),
    infix(
        "*", [](const double* x) { return x[0] * x[1]; }, "$0 * $1", Binding::product),
    infix(
        "/", [](const double* x) { return x[0] / x[1]; }, "$0 / $1", Binding::product),
    same(
        "^", 2, [](const double* x) { return std::pow(x[0], x[1]); }, nullptr),
    // A sign before a sign would be the decrement of shaders.
    {"-", nullptr, 1, [](const double* x) { return -x[0]; }, "-$0", Binding::sign, Binding::whole},
    same(
        "pow", 2, [](const double* x) { return std::pow(x[0], x[1]); }, nullptr),
    same(
        "exp", 1, [](const double* x) { return std::exp(x[0]); }, "exp($0)"),
    same(
        "exp2", 1, [](const double* x) { return std::exp2(x[0]); }, "exp2($0)"),
    same(
        "log", 1, [](const double* x) { return std::log(x[0]); }, "log($0)"),
    same(
        "log2", 1, [](const double* x) { return std::log2(x[0]); }, "log2($0)"),
    same(
        "sqrt", 1, [](const double* x) { return std::sqrt(x[0]); }, "sqrt($0)"),
    {"inversesqrt", "rsqrt", 1, [](const double* x) { return 1 / std::sqrt(x[0]); }, "inversesqrt($0)"},
    same(
        "abs", 1, [](const double* x) { return std::abs(x[0]); }, "abs($0)"),
    same(
        "sign", 1, [](const double* x) { return x[0] > 0   ? 1.0
                                                : x[0] < 0 ? -1.0
                                                           : x[0]; }, "sign($0)"),
    same(
        "floor", 1, [](const double* x) { return std::floor(x[0]); }, "floor($0)"),
    same(
        "ceil", 1, [](const double* x) { return std::ceil(x[0]); }, "ceil($0)"),
    {"fract", "frac", 1, [](const double* x) { return x[0] - std::floor(x[0]); }, "fract($0)"},
    // Not GLSL's own: HLSL's fmod and WGSL's % have the sign of their first argument.
    {"mod", nullptr, 2, [](const double* x) { return x[0] - x[1] * std::floor(x[0] / x[1]); },
     "heightlight_mod_in_@($0, $1)"},
    same(
        "min", 2, [](const double* x) { return std::min(x[0], x[1]); }, "min($0, $1)"),
    same(
        "max", 2, [](const double* x) { return std::max(x[0], x[1]); }, "max($0, $1)"),
    same(
        "clamp", 3, [](const double* x) { return clamp_value(x[0], x[1], x[2]); }, "clamp($0, $1, $2)"),
    {"saturate", nullptr, 1, [](const double* x) { return clamp_value(x[0], 0, 1); }, "clamp($0, 0.0, 1.0)"},
    {"mix", "lerp", 3, [](const double* x) { return x[0] * (1 - x[2]) + x[1] * x[2]; }, "mix($0, $1, $2)"},
    same(
        "step", 2, [](const double* x) { return x[1] < x[0] ? 0.0 : 1.0; }, "step($0, $1)"),
    same("smoothstep", 3, step_smoothly, "smoothstep($0, $1, $2)"),
    same(
        "sin", 1, [](const double* x) { return std::sin(x[0]); }, "sin($0)"),
    same(
        "cos", 1, [](const double* x) { return std::cos(x[0]); }, "cos($0)"),
    same(
        "tan", 1, [](const double* x) { return std::tan(x[0]); }, "tan($0)"),
    same(
        "asin", 1, [](const double* x) { return std::asin(x[0]); }, "asin($0)"),
    same(
        "acos", 1, [](const double* x) { return std::acos(x[0]); }, "acos($0)"),
    same(
        "atan", 1, [](const double* x) { return std::atan(x[0]); }, "atan($0)"),
};

}  // namespace

std::span<const FormulaFunction> formula_functions() { return kFunctions; }

}  // namespace heightlight
