#include "heightlight/terrain_forms.h"

#include <algorithm>

namespace heightlight {
namespace {

using Terrain = const TerrainInputs&;

double surface_share(Terrain in) { return 1 - clamp_share(in.sky_view_factor.value); }

/// Sum of a geometric series by its first term and its ratio, which is ρ_w times the share of the surface
/// that is seen. Infinite at a ratio of 1, where nothing escapes.
double sum_series(double first, double ratio) { return first > 0 ? first / (1 - ratio) : 0; }

/// n gives the first bounce and the ratio of all later ones, as in forms.h. D_w/A_w is the neighbourhood's
/// direct irradiance relative to its openness, 1 under an even sky.
double add_seen(Terrain in, SeenSkyViewFactor<double> seen) {
  const double brightness = in.window.seen_sky > 0 ? in.window.seen_direct / in.window.seen_sky : 0;
  const double reflected =
      bounced_total(in.sky_view_factor, seen, in.albedo) - clamp_share(in.sky_view_factor.value);
  return in.direct + brightness * reflected;
}

constexpr const char* kDozier = "Dozier and Frew 1990, IEEE TGRS 28(5)";
constexpr const char* kSirguey =
    "Sirguey 2009, IJRS 30(4), as the program of Lamare, Dumont and Picard has it, without its shadows";

}  // namespace

double terrain_configuration(double slope_cosine, double upper_sky) {
  return std::max(0.0, (1 + slope_cosine) / 2 - upper_sky);
}

const std::vector<TerrainForm>& terrain_forms() {
  static const std::vector<TerrainForm> forms = {
      {.name = "none",
       .description = "E0",
       .source = "the direct irradiance, taken for the whole of it",
       .evaluate = [](Terrain in) { return in.direct; }},
      {.name = "average_albedo",
       .description = "E0 + rho_w C_t E0_w, C_t = (1 + cos S)/2 - V_d",
       .source = kDozier,
       .wants_window = true,
       .evaluate =
           [](Terrain in) { return in.direct + in.window.albedo * in.configuration * in.window.direct; }},
      {.name = "average_albedo_seen",
       .description = "E0 + rho_w V E0_w, V = 1 - A",
       .source = std::string(kDozier).append(", with V for C_t"),
       .wants_window = true,
       .evaluate =
           [](Terrain in) { return in.direct + in.window.albedo * surface_share(in) * in.window.direct; }},
      {.name = "level_terrain",
       .description = "E0 + rho_w V L",
       .source = "Richter 1998, Applied Optics 37(18): terrain as bright as a level plain",
       .wants_window = true,
       .evaluate = [](Terrain in) { return in.direct + in.window.albedo * surface_share(in) * in.level; }},
      {.name = "level_series",
       .description = "E0 + rho_w C_t L/(1 - rho_w C_w)",
       .source = kSirguey,
       .wants_window = true,
       .evaluate =
           [](Terrain in) {
             const TerrainMeans& window = in.window;
             return in.direct + sum_series(window.albedo * in.configuration * in.level,
                                           window.albedo * window.configuration);
           }},
      {.name = "level_series_seen",
       .description = "E0 + rho_w V L/(1 - rho_w V_w)",
       .source = std::string(kSirguey).append(", with V for C_t"),
       .wants_window = true,
       .evaluate =
           [](Terrain in) {
             const TerrainMeans& window = in.window;
             return in.direct + sum_series(window.albedo * surface_share(in) * in.level,
                                           window.albedo * window.surface_share);
           }},
      {.name = "window_series",
       .description = "E0 + rho_w V E0_w/(1 - rho_w V_w)",
       .source = "what iterating average_albedo_seen tends to",
       .wants_window = true,
       .evaluate =
           [](Terrain in) {
             const TerrainMeans& window = in.window;
             return in.direct + sum_series(window.albedo * surface_share(in) * window.direct,
                                           window.albedo * window.surface_share);
           }},
      {.name = "own_series",
       .description = "E0/(1 - rho V)",
       .source = "the same with the texel for its neighbourhood; Jimenez et al. 2016, eq. 12",
       .evaluate = [](Terrain in) { return sum_series(in.direct, in.albedo * surface_share(in)); }},
      {.name = "cubic",
       .description = "E0/A (a A^3 - b A^2 + c A)",
       .source = kCubicText.source,
       .even_sky_only = true,
       .evaluate = [](Terrain in) { return cubic_total(in.sky_view_factor, in.albedo); }},
      {.name = "seen_from_map",
       .description = "E0 + D_w/A_w (G(A, n, rho) - A), n from A and s",
       .source = "here",
       .wants_window = true,
       .evaluate =
           [](Terrain in) { return add_seen(in, guess_seen_on_map(in.sky_view_factor, in.expected_seen)); }},
      {.name = "seen_from_deep",
       .description = "E0 + D_w/A_w (G(A, n, rho) - A), n from A and t",
       .source = "here",
       .wants_window = true,
       .evaluate =
           [](Terrain in) { return add_seen(in, guess_seen_in_deep(in.sky_view_factor, in.deep_seen)); }},
  };
  return forms;
}

}  // namespace heightlight
