#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/visibility.h"
#include "heightlight/watch.h"
#include "visibility/walk_tile.h"

// Picks the receivers on which plans are tried before the whole map is walked.

namespace heightlight {

struct CalibrationOptions {
  std::uint64_t seed = 1;
  Watch watch = {};
  BelowHorizontal below = BelowHorizontal::sky;
};

/// Size of a group of receivers on which plans are tried together.
struct CalibrationShape {
  int rows = 0;     ///< a divisor of TileFrame::kSide
  int columns = 0;  ///< a divisor of TileFrame::kSide
};

/// Side of a map of that size over 1024, at least 1. Bricks and joints alternate, and the larger the map, the
/// fewer of them one frame meets: larger maps want more frames. An exact walk that goes to the map's edge
/// takes as much longer, so that frames in proportion would cost as much more as the map itself.
double calibration_scale(int width, int height);

/// Picks parts of tiles, each of the given shape or cut off at the map's edge, one from each of `count` equal
/// parts of the map, by the seed; fewer where the map has fewer texels.
std::vector<TileFrame> pick_frames(const Surface& surface, const CalibrationShape& shape, std::int64_t count,
                                   std::uint64_t seed);

/// The i-th of `count` texels of a frame, one from each of `count` equal parts of the frame, picked by the
/// seed; where the frame has fewer texels, some are picked twice.
struct FrameTexel {
  int row = 0;  ///< row in the map
  int column = 0;
};
FrameTexel pick_in_frame(const TileFrame& frame, std::uint64_t i, std::uint64_t count, std::uint64_t seed);

}  // namespace heightlight
