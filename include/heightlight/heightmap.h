#pragma once

#include "heightlight/image.h"

namespace heightlight {

/// What lies beyond the outermost samples.
enum class Boundary {
  tile,  ///< the map repeats without end (materials)
  open   ///< nothing: a ray that leaves sees the sky, even below the horizontal (terrain)
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
};

/// Peak-to-valley height of the samples present, in world units; 0 where none is.
double relief(const Heightmap& map);

/// Samples that are missing (NaN).
std::size_t count_missing(const Heightmap& map);

/// The map with the mean of factor × factor samples (those present) in place of each such square, and the
/// spacing that goes with it: a coarser look at the same surface. Missing where all of a square is. Throws
/// UsageError for a factor that does not divide both sides.
Heightmap shrink(const Heightmap& map, int factor);

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
