#include "skylight/sky_samples.h"

#include <cmath>
#include <numbers>

#include "base/texel_algebra.h"

namespace heightlight {
namespace {

using std::numbers::pi;

/// Solid angle of a texel in a row of an image of directions, sr.
double solid_angle(const Image<Vector3>& image, int row) {
  return (std::cos(pi * row / image.height) - std::cos(pi * (row + 1) / image.height)) * 2 * pi / image.width;
}

/// Means over blocks, weighted by solid angle, so that the smaller sky sends the same flux. `rows` is at most
/// the height of the sky.
SkyLight shrink(const SkyLight& sky, int rows) {
  const Image<Vector3>& from = sky.radiance;
  Image<Eigen::Vector3d> sums(2 * rows, rows, Eigen::Vector3d::Zero());
  Image<double> angles(2 * rows, rows);
  for (int row = 0; row < from.height; ++row) {
    const double angle = solid_angle(from, row);
    const int to_row = static_cast<int>((row + 0.5) / from.height * rows);
    for (int column = 0; column < from.width; ++column) {
      const int to_column = static_cast<int>((column + 0.5) / from.width * 2 * rows);
      sums(to_row, to_column) += angle * as_eigen(from(row, column)).cast<double>();
      angles(to_row, to_column) += angle;
    }
  }
  SkyLight small{Image<Vector3>(2 * rows, rows)};
  for (std::size_t i = 0; i < angles.size(); ++i)
    small.radiance.values[i] = to_vector3((sums.values[i] / angles.values[i]).cast<float>());
  return small;
}

}  // namespace

Vector3 direction_of(const Image<Vector3>& image, int row, int column) {
  const double down = pi * (row + 0.5) / image.height;
  const double azimuth = 2 * pi * (0.75 - (column + 0.5) / image.width);
  return {static_cast<float>(std::sin(down) * std::cos(azimuth)),
          static_cast<float>(std::sin(down) * std::sin(azimuth)), static_cast<float>(std::cos(down))};
}

std::vector<SkySample> sample_sky(const SkyLight& sky, int rows) {
  const SkyLight source = sky.radiance.height > rows ? shrink(sky, rows) : sky;
  const Image<Vector3>& from = source.radiance;
  const int parts = (rows + from.height - 1) / from.height;
  const Image<Vector3> directions(from.width * parts, from.height * parts);
  std::vector<SkySample> samples;
  samples.reserve(directions.size());
  for (int row = 0; row < directions.height; ++row) {
    const auto angle = static_cast<float>(solid_angle(directions, row));
    for (int column = 0; column < directions.width; ++column)
      samples.push_back({direction_of(directions, row, column), angle, from(row / parts, column / parts)});
  }
  return samples;
}

}  // namespace heightlight
