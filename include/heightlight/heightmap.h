#pragma once

#include "heightlight/image.h"

namespace heightlight {

/// What lies beyond the outermost samples.
enum class Boundary {
  tile,  ///< the map repeats without end, as materials do
  /// There is nothing, as around terrain. A ray that leaves the map sees the sky, even below the horizontal,
  /// unless BelowHorizontal says otherwise.
  open
};

/// Returns "tile" or "open".
const char* to_string(Boundary boundary);

/// Distance between neighbouring samples along x and y, in world units, both > 0.
struct Spacing {
  double x = 0;
  double y = 0;
};

/// Heights in world units at the texel centres: the one input of every method.
struct Heightmap {
  /// Heights above `base`, so that a small relief on a large offset keeps its digits; NaN where the sample is
  /// missing.
  Image<float> height;
  /// World height of a 0 in `height`: the lowest sample, so that `height` ≥ 0.
  double base = 0;
  Spacing spacing;
  Boundary boundary = Boundary::tile;
  /// κ, per world unit: heights were lowered by κ r² (curve_heights); 0 where they were not.
  double curvature = 0;
  /// Row and column where r is 0, counted in samples from the first one; meaningless where κ is 0.
  double curved_about_row = 0;
  double curved_about_column = 0;
};

/// Returns the height from the lowest to the highest sample present, in world units; 0 where none is.
double relief(const Heightmap& map);

/// Returns the number of missing samples (NaN).
std::size_t count_missing(const Heightmap& map);

/// Returns a coarser map of the same surface. Each square of factor × factor samples becomes one sample, the
/// mean of those present, and the spacing grows by the factor. A sample is missing where its whole square is.
/// Throws UsageError for a factor below 1, or one that does not divide both sides.
Heightmap shrink(const Heightmap& map, int factor);

/// The usual coefficient k of terrestrial refraction, for places where it was not measured: light bends
/// downwards along a radius of R/k.
constexpr double kUsualRefraction = 0.13;

/// Returns the map on the Earth's curved surface: heights are lowered by κ r² with κ = (1 − k)/2R, where r is
/// the distance from the map's middle, R = 6371008.8 m (the Earth's mean radius), and k is `refraction`. One
/// world unit is a metre. Between any two places of the map, visibility is then that on a sphere of radius
/// R/(1 − k), to second order in r/R. Throws UsageError for a map that tiles or is already curved, and for k
/// outside [0, 1).
Heightmap curve_heights(Heightmap map, double refraction = kUsualRefraction);

/// Sets κ and the middle of a map that is to be lowered, and does not lower any height yet. It is the first
/// half of curve_heights, for maps whose heights are stored elsewhere. Throws UsageError as curve_heights
/// does.
void begin_curving(Heightmap& map, double refraction);

/// Returns κ r² at a sample, in world units: how much a curved map lowers its height there.
double curvature_drop(const Heightmap& map, int row, int column);

/// Slopes along the world axes x and y.
struct Gradient {
  double x = 0;
  double y = 0;
};

/// Returns the slopes, in the map's axes, of what is level at a sample: 0 unless the map is curved.
Gradient level_gradient(const Heightmap& map, int row, int column);

/// Height steps across the map's borders, compared with steps inside. In a map that tiles they are alike.
/// Every step is the root mean square of the height differences between columns (x) or rows (y), in world
/// units; NaN where there is nothing to compare.
struct EdgeSteps {
  double across_x = 0;  ///< between the last column and the first
  double inside_x = 0;  ///< between neighbouring columns, all pairs together
  /// Largest step between a single pair of neighbouring columns near a border: within an eighth of the
  /// columns, and at least four.
  double beside_x = 0;
  double across_y = 0;
  double inside_y = 0;
  double beside_y = 0;
  /// The map seems to tile: along both axes, the step across is at most 1.5 times the largest beside and 4
  /// times the one inside. An axis with nothing to compare does not count.
  bool wraps = false;
};

/// Measures the steps across the borders of a map and inside it. Missing samples are left out. Throws
/// nothing.
EdgeSteps measure_edge_steps(const Image<float>& height);

}  // namespace heightlight
