#pragma once

#include <cstdint>
#include <string>

#include "heightlight/heightmap.h"
#include "heightlight/watch.h"

namespace heightlight {

/// The relief at which a heightmap has the normals or the ambient occlusion that its material came with.
struct ReliefMatch {
  double relief = 0;       ///< world units
  double residual = 0;     ///< root mean square of what is left: degrees of normals, or A
  double correlation = 0;  ///< of slopes, or of A, at that relief
  bool y_down = false;     ///< of normals: their y points down the picture, as Direct3D has it
  std::string doubt = {};  ///< why not to believe it; empty where nothing speaks against it
};

/// From unit normals, of the map's size or another: least squares of their slopes against the map's, which
/// are in proportion to the relief, so that it is found in closed form. Slopes count by n_z⁴, as exactly as
/// they are known from components rounded alike. Maps of two sizes are compared on the smaller grid, by means
/// of slopes. Throws UsageError for a level map, and for normals that slope the other way: of an inverted
/// map.
ReliefMatch match_normals(const Heightmap& map, const Image<Vector3>& normals);

/// Texels a side of which occlusion is walked at most.
constexpr int kMatchSide = 1024;

/// From ambient occlusion, 1 = open: the relief at which A differs least from it, by root mean square, to 2
/// %, between 1/1024 of the width and all of it; downhill from 1/32. Of a map that is larger than kMatchSide,
/// the middle is walked, at its own resolution: means of heights lose the finest relief, and ask for up to
/// twice as much. Throws UsageError for a level map, and as solve does.
ReliefMatch match_occlusion(const Heightmap& map, const Map& occlusion, const Watch& watch = {});

/// Bytes that matching takes on a map of that size beside it and beside the map that it is matched to.
std::uint64_t match_bytes(int width, int height);

}  // namespace heightlight
