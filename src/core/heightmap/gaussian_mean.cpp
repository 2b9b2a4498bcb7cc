#include "heightmap/gaussian_mean.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"

namespace heightlight {
namespace {

constexpr double kCut = 4;  // in standard deviations; what is beyond has 6e-5 of the weight

/// Weights at distances 0, 1 … texels; they need not sum to 1.
std::vector<double> gaussian_weights(double sigma_texels) {
  const int radius = static_cast<int>(std::ceil(kCut * sigma_texels));
  std::vector<double> weights(static_cast<std::size_t>(radius) + 1, 1.0);
  for (int k = 1; k <= radius; ++k)
    weights[static_cast<std::size_t>(k)] = std::exp(-0.5 * (k / sigma_texels) * (k / sigma_texels));
  return weights;
}

/// Weighted sums of the values that are present, and sums of their weights.
struct WeightedSums {
  Image<double> values;
  Image<double> weights;
};

/// Calls body(neighbour, weight) for the neighbours of the i-th of `count` samples along an axis, itself
/// included.
template <class Body>
void for_neighbours(int i, int count, const std::vector<double>& weights, bool tiles, Body&& body) {
  const int radius = static_cast<int>(weights.size()) - 1;
  const int first = tiles ? i - radius : std::max(i - radius, 0);
  const int last = tiles ? i + radius : std::min(i + radius, count - 1);
  int neighbour = ((first % count) + count) % count;
  for (int at = first; at <= last; ++at) {
    body(neighbour, weights[static_cast<std::size_t>(std::abs(at - i))]);
    if (++neighbour == count) neighbour = 0;
  }
}

WeightedSums sum_along_rows(const Heightmap& map, const std::vector<double>& weights) {
  const Image<float>& h = map.height;
  WeightedSums sums{Image<double>(h.width, h.height), Image<double>(h.width, h.height)};
  parallel_for(h.height, [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    for (int column = 0; column < h.width; ++column) {
      double value = 0;
      double present = 0;
      for_neighbours(column, h.width, weights, map.boundary == Boundary::tile, [&](int j, double weight) {
        const float height = h(row, j);
        if (std::isnan(height)) return;
        value += weight * double{height};
        present += weight;
      });
      sums.values(row, column) = value;
      sums.weights(row, column) = present;
    }
  });
  return sums;
}

Image<double> mean_along_columns(const Heightmap& map, const WeightedSums& sums,
                                 const std::vector<double>& weights) {
  const Image<float>& h = map.height;
  Image<double> mean(h.width, h.height, std::numeric_limits<double>::quiet_NaN());
  parallel_for(h.height, [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    const auto width = static_cast<std::size_t>(h.width);
    std::vector<double> value(width);
    std::vector<double> present(width);
    for_neighbours(row, h.height, weights, map.boundary == Boundary::tile, [&](int i, double weight) {
      for (std::size_t column = 0; column < width; ++column) {
        const std::size_t at = sums.values.index(i, 0) + column;
        value[column] += weight * sums.values.values[at];
        present[column] += weight * sums.weights.values[at];
      }
    });
    for (int column = 0; column < h.width; ++column) {
      const auto at = static_cast<std::size_t>(column);
      if (!std::isnan(h(row, column))) mean(row, column) = value[at] / present[at];
    }
  });
  return mean;
}

}  // namespace

Image<double> gaussian_mean(const Heightmap& map, double sigma) {
  assert(sigma >= 0 && std::isfinite(sigma));
  if (sigma == 0) {
    Image<double> heights(map.height.width, map.height.height);
    std::transform(map.height.values.begin(), map.height.values.end(), heights.values.begin(),
                   [](float height) { return double{height}; });
    return heights;
  }
  const WeightedSums sums = sum_along_rows(map, gaussian_weights(sigma / map.spacing.x));
  return mean_along_columns(map, sums, gaussian_weights(sigma / map.spacing.y));
}

}  // namespace heightlight
