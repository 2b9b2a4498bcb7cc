#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/transport.h"
#include "heightlight/visibility.h"

// What is known of a solution beside the solution itself: how it was found, its errors, how well energy is
// conserved, and its cost. All solvers report it in this one type.

namespace heightlight {

/// Ways of finding what receivers see.
enum class Visibility {
  horizon_walks,  ///< the fast way, planned to reach the error wanted
  exact_slices,   ///< each slice is exact, in double precision
  rays            ///< each ray is followed to its closest hit
};

/// Errors of the maps of a sky, found on receivers picked by a hash, by comparison with exact profiles along
/// many azimuths. Every error is an RMS over the receivers. The optional ones are absent where that quantity
/// was not asked for.
struct SkyCheck {
  int receivers = 0;
  int azimuths = 0;
  double ambient_occlusion = 0;
  double sky_view_factor = 0;
  std::optional<double> bent_normal_rad = {};  ///< angle between the bent normals, rad
  std::optional<double> harmonics = {};        ///< of a coefficient of the spherical harmonics
};

/// The error of the map of one sky definition.
struct DefinitionCheck {
  SkyDefinition definition = SkyDefinition::svf_tilted;
  int azimuths = 0;                 ///< azimuths along which the map's horizons were found
  std::optional<double> rmse = {};  ///< in the definition's unit, 1 or rad; absent where nothing was checked
};

/// Conservation of energy, which must hold on any surface, as measured on this one. Extremes and means are
/// over receivers.
struct EnergyCheck {
  double row_sum_max_error = 0;   ///< largest |A + Σ F − 1|; for walks, before they scale what they gather
  double row_sum_rmse = 0;        ///< RMS of A + Σ F − 1
  double sum_max_error = 0;       ///< largest |(E₀ + … + E_K + tail)/π − 1| at ρ = 1
  double mean_total_over_pi = 1;  ///< mean of (E₀ + … + E_K + tail)/π at ρ = 1
  double tail_mean = 0;           ///< mean E/π of the tail after K bounces, at ρ = 1
  double tail_max = 0;
  double spectral_radius = 0;
};

/// Where the energy of one total goes, summed over the surface's area. What the surface receives, E₀, is
/// either absorbed by texels, (1 − ρ) E, or escapes to the sky, A ρ E. By reciprocity the received energy
/// equals the sum of both. No gather makes use of reciprocity, since form factors and sky view factors are
/// found from the receivers' side alone, so that the balance is an independent check.
struct EnergyAudit {
  double received = 0;   ///< mean E₀/π over the surface's area
  double absorbed = 0;   ///< share of the received energy that texels absorb
  double escaped = 0;    ///< share of the received energy that escapes to the sky
  double imbalance = 0;  ///< 1 − absorbed − escaped
  /// The imbalance before the total was balanced, which is the error of gathers and samples. Balanced are
  /// totals of a user-given light, and of a sky with nothing below the horizontal. For others it equals
  /// `imbalance`.
  double found_imbalance = 0;
};

/// The mean sky view factor of what texels see of the surface, weighted by how much of it they see; in
/// [0, 1].
struct SeenSky {
  /// s of the closed forms: predicted by reciprocity, from the sky view factor and the normals alone.
  double expected = 1;
  /// t of the closed forms: n of the deepest places, tuned to the whole map.
  double deep = 1;
  /// As measured from the first bounce. It differs from `expected` where samples do not resolve the surface.
  double mean = 1;
};

/// Wall-clock seconds of each step.
struct SolveTimes {
  double visibility = 0;  ///< planning, walks, and finding links
  double transport = 0;   ///< checking the row sums of the operator, where single bounces are checked
  double bounces = 0;     ///< totals, single bounces and n, without the time of the sink
  double sink = 0;        ///< time that the sink of the bounces took
  /// Estimating the errors, and finding totals once more where they miss the error wanted.
  double check = 0;
};

/// How a solution was found, its errors, and its cost.
struct Evidence {
  // How it was found.
  Visibility visibility = Visibility::horizon_walks;
  double error_wanted = 0;  ///< RMSE that was aimed at; 0 for rays and exact slices, which aim at none
  int azimuths = 0;         ///< azimuths of the sky's walks or slices; 0 for rays
  int rays = 0;             ///< rays per receiver; 0 for walks and slices
  std::uint64_t seed = 1;   ///< seed of every random choice
  /// Of horizon walks. Its part about gathers means nothing where nothing bounces.
  std::optional<HorizonPlan> plan;
  bool has_links = false;   ///< an operator was built, by stored links or by gathers
  std::uint64_t links = 0;  ///< number of stored links
  std::uint64_t link_bytes = 0;
  int bounces = 0;  ///< K, the last of the single bounces; 0 where none were asked for
  /// Of horizon walks: gathers that follow each other in finding the totals, at most over all totals.
  int gathers = 0;

  // Its errors.

  /// RMSE of A, by the most reliable check that was made; absent where A was not checked or there is no
  /// receiver.
  std::optional<double> sky_rmse;
  std::optional<SkyCheck> sky_check;               ///< of the maps of the sky
  std::vector<DefinitionCheck> definition_checks;  ///< per definition asked for
  /// Per albedo: the errors of A, and of the total in the channel with the largest error.
  std::vector<HorizonCheck> total_checks;
  std::vector<EnergyAudit> audits;  ///< per channel of each total, in the order of the totals
  /// RMSE of E₀/π … E_K/π; empty where single bounces were not asked for or not checked.
  std::vector<double> bounce_rmse;
  /// The first check found totals that miss the error wanted, and these were found once more.
  bool refined = false;

  double solver_residual = 0;  ///< largest relative residual of the linear solves on stored links
  int solver_iterations = 0;   ///< largest number of iterations among them

  // How well energy is conserved: `energy` where single bounces are checked for it, `seen` where they were
  // asked for.
  std::optional<EnergyCheck> energy;
  std::optional<SeenSky> seen;

  // What it cost.
  SolveTimes seconds;
  /// Bytes of memory at the worst moment, as estimated beforehand, links included.
  std::uint64_t estimated_bytes = 0;
  int threads = 1;
};

/// Returns a sentence that names the errors found by the checks to miss the error wanted; empty where none
/// does, or where none was wanted. An error misses if it is more than 15 % above the one wanted. The error of
/// a total also misses if it is above the one wanted and, with the check's standard error added, more than
/// 15 % above it.
std::string missed_error(const Evidence& evidence);

/// Returns the faults of a solution, one line each: an error that misses the one wanted, and a linear solve
/// that did not converge (a relative residual above 1e-6).
std::vector<std::string> find_faults(const Evidence& evidence);

}  // namespace heightlight
