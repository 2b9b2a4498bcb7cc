#include "user_form/user_form.h"

namespace heightlight {
namespace {

/// An input of the form: its argument, and the variable of the formula that is made of it.
struct ShaderInput {
  FormInput input;
  const char* argument;
  const char* variable;
};
constexpr ShaderInput kShaderInputs[] = {{FormInput::sky_view_factor, "sky", "A"},
                                         {FormInput::ambient_occlusion, "occlusion", "alpha"},
                                         {FormInput::seen, "seen", "n"}};

}  // namespace

std::string user_form_shader(const UserForm& form, ShaderLanguage language,
                             std::span<const double> constants) {
  const std::string three = language == ShaderLanguage::glsl ? "vec3" : "float3";
  std::string declared;
  std::string passed;
  std::string variables;
  for (const ShaderInput& one : kShaderInputs) {
    if (!uses(form.expression, one.input)) continue;
    declared += std::string("float ") + one.argument + ", ";
    passed += std::string(one.argument) + ", ";
    variables += std::string("  float ") + one.variable + " = heightlight_share(" + one.argument + ");\n";
  }
  const std::string name = "heightlight_" + form.name;
  return "// " + form.name + " = " + describe(form, constants) + ' ' + kUserFormSource + ".\nfloat " + name +
         '(' + declared + "float rho) {\n" + variables + "  return " +
         shader_expression(form.expression, language, constants) + ";\n}\n" + three + ' ' + name + '(' +
         declared + three + " albedo) {\n  return " + three + '(' + name + '(' + passed + "albedo.x), " +
         name + '(' + passed + "albedo.y), " + name + '(' + passed + "albedo.z));\n}\n";
}

}  // namespace heightlight
