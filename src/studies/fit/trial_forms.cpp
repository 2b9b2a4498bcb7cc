#include "fit/trial_forms.h"

namespace heightlight {
namespace {

bool is_judged_as_it_is(const ClosedForm& form) {
  return form.source != "here" || form.extra == ExtraInput::seen;
}

}  // namespace

FormFamily make_user_family(const UserForm& form) {
  const std::size_t count = form.expression.constants.size();
  FormFamily family{.name = form.name,
                    .formula = form.expression.text,
                    .source = kUserFormSource,
                    .kind = user_form_kind(form),
                    .extra = user_form_extra(form),
                    .both_kinds = wants_both_kinds(form),
                    .is_clamped = false,
                    .target = FitTarget::total,
                    .parameters = form.expression.constants,
                    .published = std::vector<double>(count, 1)};
  for (const double start : {0.5, 2.0, 0.1, 4.0, 0.0, -0.5}) family.more_starts.emplace_back(count, start);
  family.evaluate = [form](const Eigen::VectorXd& parameters, const ModelInputs& inputs, double albedo) {
    return evaluate(form, inputs, albedo, {parameters.data(), static_cast<std::size_t>(parameters.size())});
  };
  return family;
}

TrialForms list_trial_forms(const std::vector<UserForm>& own) {
  TrialForms forms;
  for (const ClosedForm& form : closed_forms()) {
    if (is_judged_as_it_is(form)) forms.fixed.push_back(form);
  }
  forms.families = form_families();
  for (const UserForm& form : own) {
    if (form.expression.constants.empty()) {
      forms.fixed.push_back(to_closed_form(form, {}));
    } else {
      forms.families.push_back(make_user_family(form));
    }
  }
  return forms;
}

}  // namespace heightlight
