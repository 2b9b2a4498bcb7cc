#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/visibility.h"
#include "heightlight/watch.h"
#include "visibility/walk_tile.h"

// Which receivers ways of walking are tried on, before the whole map is walked.

namespace heightlight {

struct CalibrationOptions {
  std::uint64_t seed = 1;
  Watch watch = {};
  BelowHorizontal below = BelowHorizontal::sky;
};

/// Sizes of what is tried together, in receivers.
struct CalibrationShape {
  int rows = 0;     ///< a divisor of TileFrame::kSide
  int columns = 0;  ///< likewise
};

/// Strips of a map of that size: bricks and joints take turns, and the larger the map the fewer of them a
/// strip meets. What calibration costs grows with the map's side, what it plans with the square.
std::int64_t calibration_strips(int width, int height);

/// Parts of tiles, one from each of `count` equal parts of the map, picked by the seed; fewer where the map
/// has fewer texels.
std::vector<TileFrame> pick_frames(const Surface& surface, const CalibrationShape& shape, std::int64_t count,
                                   std::uint64_t seed);

/// The i-th of `count` texels of a frame, one from each of as many equal parts of it, picked by the seed;
/// where the frame has fewer, some are picked twice.
struct FrameTexel {
  int row = 0;  ///< in the map
  int column = 0;
};
FrameTexel pick_in_frame(const TileFrame& frame, std::uint64_t i, std::uint64_t count, std::uint64_t seed);

}  // namespace heightlight
