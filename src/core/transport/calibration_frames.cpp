#include "transport/calibration_frames.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/hash.h"
#include "transport/sky_classes.h"

namespace heightlight {

double calibration_scale(int width, int height) {
  constexpr double kSide = 1024;
  return std::max(1.0, std::sqrt(static_cast<double>(width) * height) / kSide);
}

std::vector<TileFrame> pick_frames(const Surface& surface, const CalibrationShape& shape, std::int64_t count,
                                   std::uint64_t seed) {
  assert(TileFrame::kSide % shape.rows == 0 && TileFrame::kSide % shape.columns == 0);
  const std::int64_t texels = std::int64_t{surface.width()} * surface.height();
  const std::int64_t wanted = std::min(count, texels);
  std::vector<TileFrame> frames;
  for (std::int64_t i = 0; i < wanted; ++i) {
    const auto texel = static_cast<std::int64_t>(pick_texel(i, wanted, texels, seed));
    const int first_row = static_cast<int>(texel / surface.width()) / shape.rows * shape.rows;
    const int first_column = static_cast<int>(texel % surface.width()) / shape.columns * shape.columns;
    frames.push_back({.first_row = first_row,
                      .first_column = first_column,
                      .rows = std::min(shape.rows, surface.height() - first_row),
                      .columns = std::min(shape.columns, surface.width() - first_column)});
  }
  return frames;
}

FrameTexel pick_in_frame(const TileFrame& frame, std::uint64_t i, std::uint64_t count, std::uint64_t seed) {
  const auto texels = static_cast<std::uint64_t>(frame.rows * frame.columns);
  const std::uint64_t begin = texels * i / count;
  const std::uint64_t end = std::max(begin + 1, texels * (i + 1) / count);
  const auto pick = static_cast<int>(begin + hash_combine(seed, i) % (end - begin));
  return {.row = frame.first_row + pick / frame.columns, .column = frame.first_column + pick % frame.columns};
}

}  // namespace heightlight
