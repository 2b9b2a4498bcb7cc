#include "heightlight/closed_forms.h"

#include <cmath>

namespace heightlight {
namespace {

using Inputs = const ModelInputs&;
using Evaluate = double (*)(Inputs, double albedo);

/// Makes an entry of the list of forms. `evaluate` returns NaN outside the form's domain.
ClosedForm make_form(const FormText& text, AoKind kind, ExtraInput extra, Evaluate evaluate) {
  return {.name = text.name,
          .description = text.formula,
          .source = text.source,
          .kind = kind,
          .extra = extra,
          .both_kinds = false,
          .evaluate = [evaluate, kind](Inputs in, double albedo) -> std::optional<double> {
            const double total = evaluate(in, albedo);
            const bool missing = std::isnan(kind == AoKind::ambient_occlusion ? in.ambient_occlusion.value
                                                                              : in.sky_view_factor.value);
            if (std::isnan(total) && !missing) return std::nullopt;
            return total;
          }};
}

/// The notes' form with a value everywhere, as renderers need it.
constexpr FormText kGuardedText{"notes_guarded", "F0 + rho F1/(1 - rho tau), 1 outside its domain",
                                kNotesText.source, ""};

}  // namespace

const std::vector<ClosedForm>& closed_forms() {
  constexpr AoKind kAlpha = AoKind::ambient_occlusion;
  constexpr AoKind kSky = AoKind::sky_view_factor;
  static const std::vector<ClosedForm> forms = {
      make_form(kDirectAlphaText, kAlpha, ExtraInput::none,
                [](Inputs in, double) { return direct_irradiance(in.ambient_occlusion); }),
      make_form(kDirectText, kSky, ExtraInput::none,
                [](Inputs in, double) { return direct_irradiance(in.sky_view_factor); }),
      make_form(kNotesText, kAlpha, ExtraInput::none,
                [](Inputs in, double albedo) { return notes_total(in.ambient_occlusion, albedo); }),
      make_form(kGuardedText, kAlpha, ExtraInput::none,
                [](Inputs in, double albedo) { return notes_total_guarded(in.ambient_occlusion, albedo); }),
      make_form(kUniformNeighbourhoodText, kSky, ExtraInput::none,
                [](Inputs in, double albedo) { return uniform_neighbourhood(in.sky_view_factor, albedo); }),
      make_form(kCubicText, kSky, ExtraInput::none,
                [](Inputs in, double albedo) { return cubic_total(in.sky_view_factor, albedo); }),
      make_form(kSeenFromSkyText, kSky, ExtraInput::none,
                [](Inputs in, double albedo) {
                  return bounced_total(in.sky_view_factor, guess_seen(in.sky_view_factor), albedo);
                }),
      make_form(kSeenFromMapText, kSky, ExtraInput::expected_seen,
                [](Inputs in, double albedo) {
                  return bounced_total(in.sky_view_factor,
                                       guess_seen_on_map(in.sky_view_factor, in.expected_seen), albedo);
                }),
      make_form(kSeenFromDeepText, kSky, ExtraInput::deep_seen,
                [](Inputs in, double albedo) {
                  return bounced_total(in.sky_view_factor,
                                       guess_seen_in_deep(in.sky_view_factor, in.deep_seen), albedo);
                }),
      make_form(kSeenFromBlurText, kSky, ExtraInput::blurred,
                [](Inputs in, double albedo) {
                  return bounced_total(in.sky_view_factor, guess_seen_by_blur(in.sky_view_factor, in.blurred),
                                       albedo);
                }),
      make_form(kBouncedText, kSky, ExtraInput::seen,
                [](Inputs in, double albedo) { return bounced_total(in.sky_view_factor, in.seen, albedo); }),
  };
  return forms;
}

}  // namespace heightlight
