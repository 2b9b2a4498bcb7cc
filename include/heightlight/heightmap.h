#pragma once

#include "heightlight/image.h"

namespace heightlight {

/// What lies beyond the outermost samples.
enum class Boundary {
  tile,  ///< the map repeats without end (materials)
  open   ///< nothing: a ray that leaves sees the sky, even below the horizontal (terrain), unless
         ///< BelowHorizontal has it otherwise
};

const char* to_string(Boundary boundary);

/// Distance between neighbouring samples, in world units, both > 0.
struct Spacing {
  double x = 0;
  double y = 0;
};

/// Heights in world units at the texel centres; the one input of everything that follows.
struct Heightmap {
  Image<float>
      height;       ///< above `base`, so that small relief on a large offset keeps its digits; NaN = missing
  double base = 0;  ///< world height of 0 in `height`; the lowest sample, so that height >= 0
  Spacing spacing;
  Boundary boundary = Boundary::tile;
  double curvature = 0;         ///< κ, per world unit: heights were lowered by κ r² (curve_heights)
  double curved_about_row = 0;  ///< where r is 0, in samples from the first; means nothing where κ is 0
  double curved_about_column = 0;
};

/// Peak-to-valley height of the samples present, in world units; 0 where none is.
double relief(const Heightmap& map);

/// Samples that are missing (NaN).
std::size_t count_missing(const Heightmap& map);

/// The map with the mean of factor × factor samples (those present) in place of each such square, and the
/// spacing that goes with it: a coarser look at the same surface. Missing where all of a square is. Throws
/// UsageError for a factor that does not divide both sides.
Heightmap shrink(const Heightmap& map, int factor);

/// k of terrestrial refraction where nobody measured it: light bends downwards, along a radius of R/k.
constexpr double kUsualRefraction = 0.13;

/// The map on the Earth's curved surface: with heights lowered by κ r², κ = (1 − k)/2R, where r is the
/// distance from the map's middle, R = 6371008.8 m (the mean radius), and k the refraction. One world unit is
/// a metre. From any two places of the map one is seen from the other as on a sphere of radius R/(1 − k), to
/// second order in r/R. Throws UsageError for a map that tiles or is curved already, and for k outside
/// [0, 1).
Heightmap curve_heights(Heightmap map, double refraction = kUsualRefraction);

/// Sets how a map is to be lowered, about its middle, and lowers nothing yet: the first half of
/// curve_heights, for maps whose heights are elsewhere. Throws as that does.
void begin_curving(Heightmap& map, double refraction);

/// κ r² at a sample: by how much a curved map lowered its height.
double curvature_drop(const Heightmap& map, int row, int column);

/// Slopes along x and y.
struct Gradient {
  double x = 0;
  double y = 0;
};

/// What is level at a sample, in the map's axes: 0, unless the map is curved.
Gradient level_gradient(const Heightmap& map, int row, int column);

/// How steps across the map's borders compare with steps inside: a tile's are alike.
struct EdgeSteps {
  double across_x =
      0;  ///< root mean square of h(row, 0) − h(row, last), world units; NaN where nothing to compare
  double inside_x = 0;  ///< root mean square step between neighbouring columns
  double beside_x = 0;  ///< largest of the steps between two columns within an eighth of either border
  double across_y = 0;
  double inside_y = 0;
  double beside_y = 0;
  bool wraps = false;  ///< steps across are at most 1.5 times the largest beside and 4 times those inside
};

/// Throws nothing; missing samples are left out, and so is an axis with nothing to compare.
EdgeSteps measure_edge_steps(const Image<float>& height);

}  // namespace heightlight
