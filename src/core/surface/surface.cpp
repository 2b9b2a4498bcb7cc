#include "heightlight/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Slope at `here` along one axis from the samples before and after it (NaN where there is none): the central
/// difference, else the one-sided one, else level.
double central_slope(float before, float here, float after, double spacing) {
  const bool has_before = !std::isnan(before);
  const bool has_after = !std::isnan(after);
  const double from = has_before ? before : here;
  const double to = has_after ? after : here;
  const double steps = (has_before ? 1 : 0) + (has_after ? 1 : 0);
  return steps > 0 ? (to - from) / (steps * spacing) : 0.0;
}

/// Index of the neighbour at `i`, wrapped under `tile`; −1 where there is none.
int neighbour(int i, int count, bool tiles) {
  if (i >= 0 && i < count) return i;
  return tiles ? (i + count) % count : -1;
}

Vector3 vertex_normal(const Heightmap& map, int row, int column) {
  const Image<float>& h = map.height;
  const float here = h(row, column);
  if (std::isnan(here)) return {kMissing, kMissing, kMissing};
  const bool tiles = map.boundary == Boundary::tile;
  const auto sample = [&](int i, int j) { return i < 0 || j < 0 ? kMissing : h(i, j); };
  const float left = sample(row, neighbour(column - 1, h.width, tiles));
  const float right = sample(row, neighbour(column + 1, h.width, tiles));
  const float above = sample(neighbour(row - 1, h.height, tiles), column);
  const float below = sample(neighbour(row + 1, h.height, tiles), column);
  const double dx = central_slope(left, here, right, map.spacing.x);
  const double dy = central_slope(below, here, above, map.spacing.y);  // y points up the image
  return to_vector3(Eigen::Vector3d(-dx, -dy, 1).normalized().cast<float>());
}

void check_heightmap(const Heightmap& map) {
  const Image<float>& h = map.height;
  const bool whole = h.width >= 1 && h.height >= 1 &&
                     h.size() == static_cast<std::size_t>(h.width) * static_cast<std::size_t>(h.height);
  if (!whole) throw UsageError("height", "", "must be a rectangle of at least one sample");
  for (const double spacing : {map.spacing.x, map.spacing.y}) {
    if (!(spacing > 0) || !std::isfinite(spacing)) throw UsageError("texel", "", "must be a positive number");
  }
  if (std::any_of(h.values.begin(), h.values.end(), [](float value) { return std::isinf(value); })) {
    throw UsageError("height", "", "must be finite; NaN is a missing sample");
  }
}

}  // namespace

Surface build_surface(Heightmap map) {
  check_heightmap(map);
  Surface surface;
  surface.map = std::move(map);
  const Image<float>& h = surface.map.height;
  surface.normal = Image<Vector3>(h.width, h.height, {0, 0, 1});
  parallel_for(h.height, [&](std::int64_t row) {
    for (int column = 0; column < h.width; ++column) {
      surface.normal(static_cast<int>(row), column) =
          vertex_normal(surface.map, static_cast<int>(row), column);
    }
  });
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -lowest;
  for (const float value : h.values) {  // comparisons with NaN are false
    if (value < lowest) lowest = value;
    if (value > highest) highest = value;
  }
  surface.lowest = lowest;
  surface.highest = highest;
  return surface;
}

}  // namespace heightlight
