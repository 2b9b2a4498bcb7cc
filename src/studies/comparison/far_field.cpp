#include "comparison/far_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "heightlight/solve.h"

namespace heightlight {
namespace {

constexpr int kShrink = 8;
constexpr int kFewest = 2 * kShrink;

/// Means over squares of 8 × 8; what a side leaves over belongs to its last square. NaN where all are
/// missing.
Heightmap shrink(const Heightmap& map) {
  const int width = map.height.width / kShrink;
  const int height = map.height.height / kShrink;
  Heightmap small = map;
  small.height = Image<float>(width, height);
  small.spacing = {map.spacing.x * map.height.width / width, map.spacing.y * map.height.height / height};
  const auto begin = [](int i, int full, int part) {
    return static_cast<int>(std::int64_t{i} * full / part);
  };
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      double sum = 0;
      int count = 0;
      for (int i = begin(row, map.height.height, height); i < begin(row + 1, map.height.height, height);
           ++i) {
        for (int j = begin(column, map.height.width, width); j < begin(column + 1, map.height.width, width);
             ++j) {
          if (std::isnan(map.height(i, j))) continue;
          sum += double{map.height(i, j)};
          ++count;
        }
      }
      small.height(row, column) =
          count > 0 ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return small;
}

/// Index and share of the next along an axis; the small map's samples stand in the middle of their squares.
struct Place {
  int first;
  int second;
  float share;
};

Place place_of(int i, int full, int small, Boundary boundary) {
  const double at = (i + 0.5) * small / full - 0.5;
  const int first = static_cast<int>(std::floor(at));
  const auto within = [&](int index) {
    return boundary == Boundary::tile ? (index + small) % small : std::clamp(index, 0, small - 1);
  };
  return {within(first), within(first + 1), static_cast<float>(at - first)};
}

/// Of the four, those that have a value.
float interpolate(const Map& small, const Place& row, const Place& column) {
  float sum = 0;
  float weights = 0;
  for (const auto& [i, down] : {std::pair{row.first, 1 - row.share}, {row.second, row.share}}) {
    for (const auto& [j, right] :
         {std::pair{column.first, 1 - column.share}, {column.second, column.share}}) {
      if (std::isnan(small(i, j))) continue;
      sum += down * right * small(i, j);
      weights += down * right;
    }
  }
  return weights > 0 ? sum / weights : 1.0F;
}

}  // namespace

Map bake_far_field(const Surface& surface, std::uint64_t memory) {
  Map far(surface.width(), surface.height(), 1.0F);
  const bool has_level = surface.width() >= kFewest && surface.height() >= kFewest;
  Map small;
  if (has_level) {
    Request request;
    request.wanted.sky = true;
    request.checks = {.sky = false, .totals = false, .energy = false, .bounces = false};
    request.limits.memory = memory;
    small = solve(build_surface(shrink(surface.map)), request).sky_view_factor;
  }
  parallel_for(far.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < far.width; ++column) {
      if (std::isnan(surface.map.height(row, column))) {
        far(row, column) = std::numeric_limits<float>::quiet_NaN();
      } else if (has_level) {
        far(row, column) = interpolate(small, place_of(row, far.height, small.height, surface.map.boundary),
                                       place_of(column, far.width, small.width, surface.map.boundary));
      }
    }
  });
  return far;
}

}  // namespace heightlight
