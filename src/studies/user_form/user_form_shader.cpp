#include <cmath>

#include "user_form/user_form.h"

namespace heightlight {
namespace {

/// An input of the form: its argument, the variable of the formula that is made of it, and what it is.
struct FormArgument {
  FormInput input;
  const char* argument;
  const char* variable;
  const char* meaning;
};
constexpr FormArgument kFormArguments[] = {
    {FormInput::sky_view_factor, "sky", "A", "A, the sky view factor: cosine weighted, the AO of GTAO"},
    {FormInput::ambient_occlusion, "occlusion", "alpha",
     "alpha, the plain share of the hemisphere's solid angle that sees the sky"},
    {FormInput::seen, "seen", "n", "n, the mean sky view factor of what is seen"}};

/// How far shaders' powers and exponentials stray, at a few in a formula.
constexpr double kFormulaUlps = 16;

/// x^k. Of a negative x and a k that is no whole number, where it has no value, it is −|x|^k.
float raise(float x, float k) {
  if (k == 0) return 1;
  const float magnitude = std::pow(std::abs(x), k);
  const float half = 0.5F * k;
  return x < 0 && half - std::floor(half) > 0 ? -magnitude : magnitude;
}

ShaderFunction power_function(const std::string& name) {
  return {.name = name,
          .formula = "x^k, also of a negative x, of which pow is undefined in shaders",
          .source = "",
          .error = "",
          .inputs = {{.name = "x", .meaning = "the base", .low = -1, .is_clamped = false},
                     {.name = "k", .meaning = "the exponent", .high = 4, .is_clamped = false}},
          .text = "float " + name + R"((float x, float k) {
  if (k == 0.0) { return 1.0; }
  float magnitude = pow(abs(x), k);
  if (x < 0.0 && fract(0.5 * k) > 0.0) { return -magnitude; }
  return magnitude;
}
)",
          .twin = "std::pow",
          .evaluate = [](const float* in, float* out) { *out = raise(in[0], in[1]); },
          .ulps = kFormulaUlps};
}

ShaderFunction mod_function(const std::string& name) {
  return {.name = name,
          .formula = "x - y floor(x/y)",
          .source = "",
          .error = "",
          .inputs = {{.name = "x", .meaning = "any number", .low = -1, .is_clamped = false},
                     {.name = "y", .meaning = "any number but 0", .low = 1, .high = 2, .is_clamped = false}},
          .text = "float " + name + "(float x, float y) {\n  return x - y * floor(x / y);\n}\n",
          .twin = "mod",
          .evaluate = [](const float* in, float* out) { *out = in[0] - in[1] * std::floor(in[0] / in[1]); }};
}

/// The value that the form has for the arguments of its function, one behind the other.
double evaluate_arguments(const UserForm& form, const std::vector<double>& constants, const float* values) {
  ModelInputs inputs;
  for (const FormArgument& one : kFormArguments) {
    if (!uses(form.expression, one.input)) continue;
    const double value = double{*values++};
    if (one.input == FormInput::sky_view_factor) inputs.sky_view_factor = SkyViewFactor(value);
    if (one.input == FormInput::ambient_occlusion) inputs.ambient_occlusion = AmbientOcclusion(value);
    if (one.input == FormInput::seen) inputs.seen = SeenSkyViewFactor(value);
  }
  return evaluate(form, inputs, double{*values}, constants);
}

}  // namespace

std::vector<ShaderFunction> user_form_functions(const UserForm& form, const std::vector<double>& constants) {
  const std::string name = "heightlight_" + form.name;
  ShaderFunction function{.name = name,
                          .formula = describe(form, constants),
                          .source = kUserFormSource,
                          .error = "",
                          .inputs = {},
                          .is_per_channel = true,
                          .text = "",
                          .twin = form.name,
                          .evaluate =
                              [form, constants](const float* in, float* out) {
                                *out = static_cast<float>(evaluate_arguments(form, constants, in));
                              },
                          .ulps = kFormulaUlps};
  std::string declared;
  std::string variables;
  for (const FormArgument& one : kFormArguments) {
    if (!uses(form.expression, one.input)) continue;
    declared += std::string("float ") + one.argument + ", ";
    variables += std::string("  float ") + one.variable + " = heightlight_share(" + one.argument + ");\n";
    function.inputs.push_back({one.argument, one.meaning});
  }
  function.inputs.push_back(
      {.name = "rho", .meaning = "albedo of the surface all around, linear", .is_clamped = false});
  const std::string text = shader_expression(form.expression, constants, form.name);
  function.text =
      "float " + name + '(' + declared + "float rho) {\n" + variables + "  return " + text + ";\n}\n";
  std::vector<ShaderFunction> functions;
  const std::string power = "heightlight_power_in_" + form.name;
  const std::string mod = "heightlight_mod_in_" + form.name;
  if (text.find(power + '(') != std::string::npos) functions.push_back(power_function(power));
  if (text.find(mod + '(') != std::string::npos) functions.push_back(mod_function(mod));
  functions.push_back(std::move(function));
  return functions;
}

}  // namespace heightlight
