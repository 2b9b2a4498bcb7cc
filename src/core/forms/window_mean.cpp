#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/parallel.h"
#include "base/texels.h"
#include "heightlight/error.h"
#include "heightlight/terrain_forms.h"

namespace heightlight {
namespace {

/// Sums over stretches of a line of values that stops at its ends, or repeats.
class LineSums {
 public:
  LineSums(std::size_t length, bool repeats) : repeats_(repeats), sums_(length + 1) {}

  template <class Value>
  void fill(Value&& value) {
    for (std::size_t i = 0; i + 1 < sums_.size(); ++i) sums_[i + 1] = sums_[i] + value(i);
  }

  /// The sum from `middle − radius` to `middle + radius`, both included.
  double around(std::int64_t middle, std::int64_t radius) const {
    return up_to(middle + radius + 1) - up_to(middle - radius);
  }

 private:
  double up_to(std::int64_t end) const {
    const auto length = static_cast<std::int64_t>(sums_.size()) - 1;
    if (!repeats_) return sums_[static_cast<std::size_t>(std::clamp<std::int64_t>(end, 0, length))];
    const std::int64_t within = ((end % length) + length) % length;
    const std::int64_t turns = (end - within) / length;
    return static_cast<double>(turns) * sums_.back() + sums_[static_cast<std::size_t>(within)];
  }

  bool repeats_;
  std::vector<double> sums_;
};

/// Number of texels that a radius reaches; limited to 2³⁰, more than any map needs.
std::int64_t texels_within(double radius, double spacing) {
  return static_cast<std::int64_t>(std::min(radius / spacing * (1 + 1e-12), 0x1p30));
}

/// Replaces each value by the sum over the box around it, first along rows and then along columns.
void sum_box(const Surface& surface, double radius, TexelVector& values) {
  const Image<float>& map = surface.map.height;
  const std::int64_t across = texels_within(radius, surface.map.spacing.x);
  const std::int64_t down = texels_within(radius, surface.map.spacing.y);
  parallel_for(map.height, [&](std::int64_t row) {
    LineSums sums(static_cast<std::size_t>(map.width), surface.tiles());
    double* line = values.data() + row * map.width;
    sums.fill([&](std::size_t i) { return line[i]; });
    for (int column = 0; column < map.width; ++column) line[column] = sums.around(column, across);
  });
  parallel_for(map.width, [&](std::int64_t column) {
    LineSums sums(static_cast<std::size_t>(map.height), surface.tiles());
    double* line = values.data() + column;
    sums.fill([&](std::size_t i) { return line[i * static_cast<std::size_t>(map.width)]; });
    for (std::int64_t row = 0; row < map.height; ++row) line[row * map.width] = sums.around(row, down);
  });
}

}  // namespace

TexelVector window_mean(const Surface& surface, const TexelVector& values, const TexelVector& weights,
                        double radius) {
  const std::size_t size = surface.map.height.size();
  if (values.size() != size || weights.size() != size)
    throw UsageError("values and weights of a window must have the surface's size");
  if (!(radius >= 0)) throw UsageError("radius", "", "must not be negative");
  TexelVector weighted(size, 0.0);
  TexelVector sums(size, 0.0);
  const auto is_missing = [&](std::size_t i) { return std::isnan(surface.map.height.values[i]); };
  for_texels(surface.map.height, [&](std::size_t i) {
    if (is_missing(i)) return;
    sums[i] = weights[i];
    weighted[i] = weights[i] * values[i];
  });
  sum_box(surface, radius, sums);
  sum_box(surface, radius, weighted);
  for_texels(surface.map.height, [&](std::size_t i) {
    weighted[i] = is_missing(i) || !(sums[i] > 0) ? 0 : weighted[i] / sums[i];
  });
  return weighted;
}

}  // namespace heightlight
