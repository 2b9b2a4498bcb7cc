#include "user_form/user_form.h"

#include <algorithm>
#include <cmath>

#include "base/digits.h"
#include "files/printable.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr std::size_t kLongestName = 40;

bool is_form_name(const std::string& name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= kLongestName && is_letter(name[0]) &&
         name.find("__") == std::string::npos &&  // which GLSL keeps for itself
         std::all_of(name.begin(), name.end(),
                     [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; });
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Names under which tables or shaders already hold something of this program's.
bool is_taken(const std::string& name) {
  const bool is_form = std::any_of(closed_forms().begin(), closed_forms().end(),
                                   [&](const ClosedForm& form) { return form.name == name; });
  const auto is_called_so = [&](const ShaderFunction& function) {
    return function.name == "heightlight_" + name;
  };
  const bool is_function = std::any_of(shader_functions().begin(), shader_functions().end(), is_called_so);
  const bool is_family = name.starts_with("notes_") || name.starts_with("cubic_") ||
                         name.starts_with("power_in_") || name.starts_with("mod_in_") ||
                         name.starts_with("seen_") || name.starts_with("bounce_") ||
                         name.ends_with("_refit") || name.ends_with("_fitted");
  return is_form || is_function || is_family;
}

}  // namespace

UserForm parse_user_form(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string shown = printable("'" + text + "'");
  if (equals == std::string::npos)
    throw UsageError("form", shown, "must be NAME = EXPRESSION, as in 'mine = A/(1 - rho*(1 - A)^k)'");
  UserForm form;
  form.name = trimmed(text.substr(0, equals));
  if (!is_form_name(form.name))
    throw UsageError(
        "form", shown,
        printable("'" + form.name + "' is no name: a letter, then letters, digits and _, at most " +
                  std::to_string(kLongestName)));
  if (is_taken(form.name)) throw UsageError("form", shown, form.name + " is a name of this program's own");
  form.expression = parse_expression(text, equals + 1);
  return form;
}

AoKind user_form_kind(const UserForm& form) {
  return uses(form.expression, FormInput::ambient_occlusion) &&
                 !uses(form.expression, FormInput::sky_view_factor)
             ? AoKind::ambient_occlusion
             : AoKind::sky_view_factor;
}

ExtraInput user_form_extra(const UserForm& form) {
  return uses(form.expression, FormInput::seen) ? ExtraInput::seen : ExtraInput::none;
}

bool wants_both_kinds(const UserForm& form) {
  return uses(form.expression, FormInput::ambient_occlusion) &&
         uses(form.expression, FormInput::sky_view_factor);
}

double evaluate(const UserForm& form, const ModelInputs& inputs, double albedo,
                std::span<const double> constants) {
  const FormInputs values{clamp_share(inputs.sky_view_factor.value),
                          clamp_share(inputs.ambient_occlusion.value), clamp_share(inputs.seen.value),
                          albedo};
  return evaluate(form.expression, values, constants);
}

ClosedForm to_closed_form(const UserForm& form, const std::vector<double>& constants) {
  return {.name = form.name,
          .description = describe(form, constants),
          .source = kUserFormSource,
          .kind = user_form_kind(form),
          .extra = user_form_extra(form),
          .both_kinds = wants_both_kinds(form),
          .evaluate = [form, constants](const ModelInputs& inputs, double albedo) -> std::optional<double> {
            const double total = evaluate(form, inputs, albedo, constants);
            if (std::isfinite(total)) return total;
            return std::nullopt;
          }};
}

std::string describe(const UserForm& form, std::span<const double> constants) {
  constexpr int kDigits = 5;
  std::string text = form.expression.text;
  for (std::size_t i = 0; i < constants.size(); ++i)
    text += ", " + form.expression.constants[i] + " = " + in_digits(constants[i], kDigits);
  return text;
}

}  // namespace heightlight
