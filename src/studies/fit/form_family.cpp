#include "fit/form_family.h"

#include <iterator>
#include <utility>

#include "fit/judged_map.h"
#include "user_form/user_form.h"

namespace heightlight {
namespace {

using Eigen::VectorXd;
using Inputs = const ModelInputs&;
using Parameters = const VectorXd&;

/// A constant that is fitted: what reports call it, and where it is kept.
template <class Constants>
using Fitted = FormConstant<Constants>;

/// `fixed` with the fitted constants in their places.
template <class Constants>
Constants with_parameters(const std::vector<Fitted<Constants>>& fitted, Parameters parameters,
                          Constants fixed) {
  for (std::size_t i = 0; i < fitted.size(); ++i)
    fixed.*fitted[i].value = parameters[static_cast<Eigen::Index>(i)];
  return fixed;
}

/// What a family's form makes of its constants.
template <class Constants>
using Form = double (*)(const Constants&, Inputs, double albedo);

/// A family of one form: `fitted` are free, the others as `fixed` has them, and all start from there.
template <class Constants>
FormFamily make_family(const FormText& text, FitTarget target, std::vector<Fitted<Constants>> fitted,
                       Form<Constants> form, const Constants& fixed = {}) {
  FormFamily family{.name = text.name, .formula = text.formula, .source = text.source, .target = target};
  for (const Fitted<Constants>& constant : fitted) {
    family.parameters.emplace_back(constant.name);
    family.published.push_back(fixed.*constant.value);
  }
  family.evaluate = [fitted = std::move(fitted), form, fixed](Parameters p, Inputs in, double albedo) {
    return form(with_parameters(fitted, p, fixed), in, albedo);
  };
  return family;
}

FormFamily over_alpha(FormFamily family) {
  family.kind = AoKind::ambient_occlusion;
  return family;
}

FormFamily of_bounce(std::size_t bounce, FormFamily family) {
  family.bounce = bounce;
  return family;
}

FormFamily with_extra(FormFamily family, ExtraInput extra) {
  family.extra = extra;
  return family;
}

/// F₀ with power 1 does not exceed 1 as long as its gain does not.
constexpr FormText kBoundedDirectText{"notes_direct_bounded", "alpha (1 + gain (1 - alpha))",
                                      "Patapom, eq. 7 with power 1, at most 1", ""};

std::vector<FormFamily> notes_families() {
  const Form<NotesConstants> direct = [](const NotesConstants& c, Inputs in, double) {
    return notes_direct(in.ambient_occlusion, c);
  };
  const Form<NotesConstants> first = [](const NotesConstants& c, Inputs in, double) {
    return notes_first_bounce(in.ambient_occlusion, c);
  };
  NotesConstants bounded;
  bounded.direct_power = 1;
  return {
      over_alpha(make_family<NotesConstants>(
          kNotesDirectText, FitTarget::one_bounce,
          {{"gain", &NotesConstants::direct_gain}, {"power", &NotesConstants::direct_power}}, direct)),
      over_alpha(make_family<NotesConstants>(kBoundedDirectText, FitTarget::one_bounce,
                                             {{"gain", &NotesConstants::direct_gain}}, direct, bounded)),
      of_bounce(1, over_alpha(make_family<NotesConstants>(
                       kNotesFirstBounceText, FitTarget::one_bounce,
                       {{"A", &NotesConstants::first_gain}, {"B", &NotesConstants::first_decay}}, first)))};
}

/// As a polynomial, not held in [0, 1].
FormFamily cubic_family(const char* name, FitTarget target) {
  const FormText text{name, "a A^3 - b A^2 + c A; a, b, c linear in albedo", kCubicText.source, ""};
  return make_family<CubicConstants>(text, target, {std::begin(kCubicConstants), std::end(kCubicConstants)},
                                     [](const CubicConstants& c, Inputs in, double albedo) {
                                       return cubic_polynomial(in.sky_view_factor, albedo, c);
                                     });
}

/// Of this project's constants, which are as fitted to the maps of plots/make-models: on as many maps what is
/// known beforehand hardly counts, on two alike it bounds what they leave open.
constexpr double kPriorError = 0.005;

std::vector<FormFamily> seen_families() {
  using C = SeenConstants;
  return {
      make_family<C>(kSeenFromSkyText, FitTarget::total, {{"offset", &C::offset}, {"slope", &C::slope}},
                     [](const C& c, Inputs in, double albedo) {
                       return bounced_total(in.sky_view_factor, guess_seen(in.sky_view_factor, c), albedo);
                     }),
      with_extra(make_family<C>(
                     kSeenFromMapText, FitTarget::total,
                     {{"offset", &C::map_offset}, {"slope", &C::map_slope}, {"curvature", &C::map_curvature}},
                     [](const C& c, Inputs in, double albedo) {
                       return bounced_total(in.sky_view_factor,
                                            guess_seen_on_map(in.sky_view_factor, in.expected_seen, c),
                                            albedo);
                     }),
                 ExtraInput::expected_seen),
      with_extra(make_family<C>(kSeenFromDeepText, FitTarget::total,
                                {{"slope", &C::deep_slope}, {"bend", &C::deep_bend}},
                                [](const C& c, Inputs in, double albedo) {
                                  return bounced_total(
                                      in.sky_view_factor,
                                      guess_seen_in_deep(in.sky_view_factor, in.deep_seen, c), albedo);
                                }),
                 ExtraInput::deep_seen),
      with_extra(make_family<C>(kSeenFromBlurText, FitTarget::total,
                                {{"offset", &C::blur_offset}, {"slope", &C::blur_slope}},
                                [](const C& c, Inputs in, double albedo) {
                                  return bounced_total(in.sky_view_factor,
                                                       guess_seen_by_blur(in.sky_view_factor, in.blurred, c),
                                                       albedo);
                                }),
                 ExtraInput::blurred)};
}

}  // namespace

const std::vector<FormFamily>& form_families() {
  static const std::vector<FormFamily> families = [] {
    std::vector<FormFamily> all = notes_families();
    all.push_back(cubic_family("cubic_three_bounces", FitTarget::three_bounces));
    all.push_back(cubic_family("cubic", FitTarget::total));
    for (FormFamily& family : seen_families()) {
      family.prior_error = kPriorError;
      all.push_back(std::move(family));
    }
    return all;
  }();
  return families;
}

const char* origin_of_constants(const FormFamily& family) {
  if (family.source == kUserFormSource) return "start";
  return family.source == "here" ? "default" : "published";  // as FormText::source has it
}

const std::vector<double>& target_albedos(FitTarget target) {
  static const std::vector<double> none{1.0};
  static const std::vector<double> appendix_b{0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9};
  static const std::vector<double> below_one(judged_albedos().begin(), judged_albedos().end() - 1);
  switch (target) {
    case FitTarget::total:
      return below_one;
    case FitTarget::three_bounces:
      return appendix_b;
    default:
      return none;
  }
}

}  // namespace heightlight
