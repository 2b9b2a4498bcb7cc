#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/evidence.h"
#include "heightlight/sun.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "terrain/terrain_methods.h"

namespace heightlight {

/// What is tried.
struct TrialOptions {
  std::vector<double> albedos = {0.15, 0.6, 0.9};  ///< grass, old snow, new snow; the same everywhere
  Sun sun;
  std::vector<double> window_cells = {5, 20,
                                      80};  ///< radii of windows, in texels (their geometric mean side)
  double error = 5e-4;                      ///< RMSE wanted of the truth, and of A
  std::uint64_t memory = ~0ULL;             ///< bytes that finding the truth may take
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// One line of the table: a form under a light at an albedo.
struct TerrainFormRow {
  std::string light = {};  ///< "sky" or "sun"
  double albedo = 0;
  std::string form = {};
  double window = 0;         ///< radius, world units; 0 where the form takes no means
  QuantityError error = {};  ///< of E/π, form − truth, over all texels that are present
  double reflected = 0;      ///< mean of what terrain reflects, by the truth, E/π

  /// Of what is reflected, in the mean.
  double relative_rmse() const { return reflected > 0 ? error.rmse / reflected : 0; }
  double relative_bias() const { return reflected > 0 ? error.bias / reflected : 0; }
};

/// A light, and the truth under it.
struct TrialLight {
  std::string name;  ///< "sky" or "sun"
  double level = 1;  ///< E/π of a level open plane
  TexelVector direct;
  double mean_direct = 0;
  std::vector<TexelVector> totals;  ///< E/π per albedo
  Evidence evidence;                ///< of the totals
};

struct TerrainTrial {
  std::vector<TerrainFormRow> rows;
  std::vector<TrialLight> lights;
  double expected_seen = 1;   ///< s
  double deep_seen = 1;       ///< t
  double mean_sky = 1;        ///< of A
  double mean_upper_sky = 1;  ///< of V_d
  Cost sun_cost;
};

/// Tries terrain_forms() on a surface against light transport to convergence: under an even sky, which also
/// shines from below the horizontal where the map ends, and under the sun alone. Throws what solve and
/// sun_irradiance throw.
TerrainTrial try_terrain_forms(const Surface& surface, const TrialOptions& options);

/// Bytes per texel that a trial holds beside what finding the truth takes.
std::uint64_t trial_bytes_per_texel(std::size_t albedos);

}  // namespace heightlight
