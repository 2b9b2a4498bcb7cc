#include "comparison/error_statistics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/percentile.h"
#include "base/texel_algebra.h"

namespace heightlight {

double peak_signal_to_noise(const ErrorStatistics& error) { return -20 * std::log10(error.rmse); }

Map subtract(const Map& map, const Map& reference) {
  assert(map.size() == reference.size());
  Map differences(map.width, map.height);
  for (std::size_t i = 0; i < map.size(); ++i) differences.values[i] = map.values[i] - reference.values[i];
  return differences;
}

Map angles_deg(const Image<Vector3>& vectors, const Image<Vector3>& reference) {
  assert(vectors.size() == reference.size());
  Map angles(vectors.width, vectors.height);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    const Eigen::Vector3d a = as_eigen(vectors.values[i]).cast<double>();
    const Eigen::Vector3d b = as_eigen(reference.values[i]).cast<double>();
    angles.values[i] = static_cast<float>(std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
  }
  return angles;
}

int thinning_step(int width, int height) {
  constexpr int kSide = 256;
  return (std::max(width, height) + kSide - 1) / kSide;
}

Map thin_out(const Map& map) {
  const int step = thinning_step(map.width, map.height);
  Map thin((map.width + step - 1) / step, (map.height + step - 1) / step);
  for (int row = 0; row < thin.height; ++row) {
    for (int column = 0; column < thin.width; ++column) thin(row, column) = map(row * step, column * step);
  }
  return thin;
}

ErrorStatistics measure(const Map& differences) {
  std::vector<float> sizes;
  double squares = 0;
  double sum = 0;
  for (const float difference : differences.values) {
    if (std::isnan(difference)) continue;
    sizes.push_back(std::fabs(difference));
    squares += double{difference} * double{difference};
    sum += double{difference};
  }
  ErrorStatistics error;
  if (sizes.empty()) return error;
  const auto count = static_cast<double>(sizes.size());
  error.rmse = std::sqrt(squares / count);
  error.bias = sum / count;
  error.p99 = percentile(std::span(sizes), 0.99);
  error.largest = double{*std::max_element(sizes.begin(), sizes.end())};
  return error;
}

}  // namespace heightlight
