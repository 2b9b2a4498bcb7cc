#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/transport.h"
#include "heightlight/visibility.h"

// What is known of a solution beside the solution: how it was found, what it errs by, how well energy is
// kept, what it cost. One type for all who solve.

namespace heightlight {

/// Ways of finding what receivers see.
enum class Visibility {
  horizon_walks,  ///< planned for the error wanted: the fast way
  exact_slices,   ///< along every azimuth exactly, in double precision
  rays            ///< to the closest hit
};

/// What a sky's maps err by on receivers picked by a hash, against exact profiles along many azimuths. RMS;
/// absent where it was not wanted.
struct SkyCheck {
  int receivers = 0;
  int azimuths = 0;
  double ambient_occlusion = 0;
  double sky_view_factor = 0;
  std::optional<double> bent_normal_rad = {};  ///< angle
  std::optional<double> harmonics = {};        ///< of a coefficient
};

/// Likewise of a map of a definition.
struct DefinitionCheck {
  SkyDefinition definition = SkyDefinition::svf_tilted;
  int azimuths = 0;                 ///< along which horizons were found
  std::optional<double> rmse = {};  ///< in the definition's unit; absent where nothing was checked
};

/// What must hold of any surface, as measured on this one.
struct EnergyCheck {
  double row_sum_max_error = 0;   ///< |sky + Σ F − 1|, of walks before they scale what they gather
  double row_sum_rmse = 0;        ///< the same, as an RMS
  double sum_max_error = 0;       ///< |E₀ + … + E_K + tail − 1| at ρ = 1, in units of π
  double mean_total_over_pi = 1;  ///< mean of that sum
  double tail_mean = 0;           ///< of the tail after K bounces at ρ = 1, E/π
  double tail_max = 0;
  double spectral_radius = 0;
};

/// Where the light of one total went, summed over the surface's area. What is received is absorbed by texels,
/// (1 − ρ) E, or escapes to the sky, A ρ E. That the three agree is reciprocity, which no gather knows of:
/// form factors and sky view factors are found from the receivers' side alone.
struct EnergyAudit {
  double received = 0;         ///< mean E₀/π over the surface's area
  double absorbed = 0;         ///< share of what is received
  double escaped = 0;          ///< likewise
  double imbalance = 0;        ///< 1 less both
  double found_imbalance = 0;  ///< the same before the total was balanced, which light of one's own is: what
                               ///< gathers and samples err by. Where nothing was balanced, as `imbalance`
};

/// The mean sky view factor of what texels see, weighted by how much of it they see.
struct SeenSky {
  double expected = 1;  ///< by reciprocity, from the sky view factor and the normals alone
  double deep = 1;      ///< t of the closed forms: what the deepest places see, tuned to the whole map
  double mean = 1;  ///< as the first bounce brings it; the two part where samples don't resolve the surface
};

/// Wall seconds of each step.
struct SolveTimes {
  double visibility = 0;  ///< planning, walks, links
  double transport = 0;   ///< setting up the operator: for stored links, counting and checking them
  double bounces = 0;     ///< without what the sink of the bounces took
  double sink = 0;        ///< what the sink of the bounces took
  double check = 0;       ///< estimating the errors
};

struct Evidence {
  // How it was found.
  Visibility visibility = Visibility::horizon_walks;
  double error_wanted = 0;          ///< RMSE; 0 where rays or exact slices aim at none
  int azimuths = 0;                 ///< of the sky; 0 of rays
  int rays = 0;                     ///< 0 of walks and slices
  std::uint64_t seed = 1;           ///< of every random choice
  std::optional<HorizonPlan> plan;  ///< of horizon walks; its gathers mean nothing where nothing bounces
  bool has_links = false;           ///< an operator was built, of stored links or gathers
  std::uint64_t links = 0;          ///< stored
  std::uint64_t link_bytes = 0;
  int bounces = 0;  ///< gathered one after the other
  int gathers = 0;  ///< of horizon walks: for the totals, one after the other

  // What it errs by.
  std::optional<double> sky_rmse;     ///< of A: the best figure there is; absent where no receiver is
  std::optional<SkyCheck> sky_check;  ///< of the sky's maps
  std::vector<DefinitionCheck> definition_checks;  ///< per definition asked for
  std::vector<HorizonCheck>
      total_checks;                 ///< per albedo, of A and of the total in the channel that errs most
  std::vector<EnergyAudit> audits;  ///< per channel of each total, in their order
  std::vector<double> bounce_rmse;  ///< of E₀/π … E_K/π, where single bounces were asked for
  bool refined = false;  ///< the first check found totals that miss the error: these were found once more

  double solver_residual = 0;  ///< largest relative residual of the linear solves on stored links
  int solver_iterations = 0;   ///< largest number of iterations among them

  // How well energy is kept, where single bounces were asked for.
  std::optional<EnergyCheck> energy;
  std::optional<SeenSky> seen;

  // What it cost.
  SolveTimes seconds;
  std::uint64_t estimated_bytes =
      0;  ///< of memory, links included, as estimated beforehand for the worst moment
  int threads = 1;
};

/// Says in words which errors the checks found to be 15 % or more above the one wanted, or of totals less
/// where the check's standard error leaves that open; empty where none is, or where none was wanted.
std::string missed_error(const Evidence& evidence);

/// All that speaks against a solution, a line each: an error that is missed, a linear solve that did not
/// converge.
std::vector<std::string> find_faults(const Evidence& evidence);

}  // namespace heightlight
