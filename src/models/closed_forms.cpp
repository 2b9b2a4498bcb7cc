#include "heightlight/models.h"

namespace heightlight {

const std::vector<ClosedForm>& closed_forms() {
  constexpr AoKind kAlpha = AoKind::ambient_occlusion;
  constexpr AoKind kSky = AoKind::sky_view_factor;
  using Inputs = const ModelInputs&;
  using Result = std::optional<double>;
  static const std::vector<ClosedForm> forms = {
      {"direct_alpha", "alpha", "file 004 eq. 4", kAlpha, ExtraInput::none,
       [](Inputs in, double) -> Result { return direct_irradiance(in.ambient_occlusion); }},
      {"direct", "A", "AO x pi", kSky, ExtraInput::none,
       [](Inputs in, double) -> Result { return direct_irradiance(in.sky_view_factor); }},
      {"notes", "F0 + rho F1/(1 - rho tau)", "file 004 eqs. 7, 9 to 12", kAlpha, ExtraInput::none,
       [](Inputs in, double albedo) { return notes_total(in.ambient_occlusion, albedo); }},
      {"notes_guarded", "F0 + rho F1/(1 - rho tau), 1 outside its domain", "file 004 eqs. 7, 9 to 12", kAlpha,
       ExtraInput::none,
       [](Inputs in, double albedo) -> Result { return notes_total_guarded(in.ambient_occlusion, albedo); }},
      {"uniform_neighbourhood", "A/(1 - rho (1 - A))", "file 000 eq. 12; file 002 eq. 6", kSky,
       ExtraInput::none,
       [](Inputs in, double albedo) -> Result { return uniform_neighbourhood(in.sky_view_factor, albedo); }},
      {"cubic", "a A^3 - b A^2 + c A", "file 000 eq. 33", kSky, ExtraInput::none,
       [](Inputs in, double albedo) -> Result { return cubic_total(in.sky_view_factor, albedo); }},
      {"seen_from_sky", "G(A, n, rho), n from A", "here", kSky, ExtraInput::none,
       [](Inputs in, double albedo) -> Result {
         return bounced_total(in.sky_view_factor, guess_seen(in.sky_view_factor), albedo);
       }},
      {"seen_from_map", "G(A, n, rho), n from A and s", "here", kSky, ExtraInput::expected_seen,
       [](Inputs in, double albedo) -> Result {
         return bounced_total(in.sky_view_factor, guess_seen_on_map(in.sky_view_factor, in.expected_seen),
                              albedo);
       }},
      {"seen_from_deep", "G(A, n, rho), n from A and t", "here", kSky, ExtraInput::deep_seen,
       [](Inputs in, double albedo) -> Result {
         return bounced_total(in.sky_view_factor, guess_seen_in_deep(in.sky_view_factor, in.deep_seen),
                              albedo);
       }},
      {"seen_from_blur", "G(A, n, rho), n from A and its blur", "here", kSky, ExtraInput::blurred,
       [](Inputs in, double albedo) -> Result {
         return bounced_total(in.sky_view_factor, guess_seen_by_blur(in.sky_view_factor, in.blurred), albedo);
       }},
      {"seen_stored", "G(A, n, rho), n a second channel", "here", kSky, ExtraInput::seen,
       [](Inputs in, double albedo) -> Result { return bounced_total(in.sky_view_factor, in.seen, albedo); }},
  };
  return forms;
}

}  // namespace heightlight
