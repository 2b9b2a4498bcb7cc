#include "heightlight/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "skylight/sky_samples.h"

namespace heightlight {
namespace {

using std::numbers::pi;

/// A place in the image, in texels from its upper left corner.
struct Place {
  double column = 0;
  double row = 0;
};

Place place_of(const Image<Vector3>& image, const Vector3& direction) {
  const double x = double{direction.x};
  const double y = double{direction.y};
  const double down = std::atan2(std::hypot(x, y), double{direction.z}) / pi;
  double turn = 0.75 - std::atan2(y, x) / (2 * pi);
  turn -= std::floor(turn);
  return {turn * image.width, down * image.height};
}

/// A texel whose row may lie one beyond a pole, and is then found on the pole's other side, and whose column
/// may lie one beyond either side.
const Vector3& texel_around(const Image<Vector3>& image, int row, int column) {
  const int within = std::clamp(row, 0, image.height - 1);
  const int across = row == within ? 0 : image.width / 2;
  return image(within, (column + across + image.width) % image.width);
}

bool is_radiance(float value) { return std::isfinite(value) && value >= 0; }

}  // namespace

void check_sky_light(const SkyLight& sky) {
  const Image<Vector3>& image = sky.radiance;
  if (image.height < 1 || image.width != 2 * image.height)
    throw UsageError("a sky of latitude by longitude has two columns to a row, not " +
                     std::to_string(image.width) + " × " + std::to_string(image.height) + " texels");
  const bool holds = std::all_of(image.values.begin(), image.values.end(), [](const Vector3& value) {
    return is_radiance(value.x) && is_radiance(value.y) && is_radiance(value.z);
  });
  if (!holds) throw UsageError("a sky's radiance must be finite, and nowhere negative");
}

SkyLight two_tone_sky() {
  constexpr Vector3 kWarm{1, 0.6F, 0.3F};
  constexpr Vector3 kCold{0.3F, 0.6F, 1};
  SkyLight sky{Image<Vector3>(4, 2, kCold)};
  for (int row = 0; row < 2; ++row) sky.radiance(row, 1) = sky.radiance(row, 2) = kWarm;
  return sky;
}

SkyLight overcast_sky() {
  constexpr int kSkyRows = 512;
  SkyLight sky{Image<Vector3>(2 * kSkyRows, kSkyRows)};
  for (int row = 0; row < kSkyRows / 2; ++row) {
    const double elevation = pi / 2 - pi * (row + 0.5) / kSkyRows;
    const auto radiance = static_cast<float>(9.0 / 7 * (1 + 2 * std::sin(elevation)) / 3);
    for (int column = 0; column < 2 * kSkyRows; ++column)
      sky.radiance(row, column) = {radiance, radiance, radiance};
  }
  return sky;
}

Vector3 radiance_from(const SkyLight& sky, const Vector3& direction) {
  const Image<Vector3>& image = sky.radiance;
  const Place place = place_of(image, direction);
  return image(std::min(static_cast<int>(place.row), image.height - 1),
               std::min(static_cast<int>(place.column), image.width - 1));
}

Vector3 look_up(const SkyLight& sky, const Vector3& direction) {
  const Image<Vector3>& image = sky.radiance;
  const Place place = place_of(image, direction);
  const double left = std::floor(place.column - 0.5);
  const double top = std::floor(place.row - 0.5);
  const double across = place.column - 0.5 - left;
  const double down = place.row - 0.5 - top;
  Eigen::Vector3f value = Eigen::Vector3f::Zero();
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      const double weight = (i == 1 ? down : 1 - down) * (j == 1 ? across : 1 - across);
      value += static_cast<float>(weight) *
               as_eigen(texel_around(image, static_cast<int>(top) + i, static_cast<int>(left) + j));
    }
  }
  return to_vector3(value);
}

SkyLight open_irradiance(const SkyLight& sky, int rows) {
  constexpr int kFiner = 4;  // directions per texel of the result, along each axis
  const std::vector<SkySample> samples = sample_sky(sky, kFiner * rows);
  SkyLight open{Image<Vector3>(2 * rows, rows)};
  parallel_for(rows, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < open.radiance.width; ++column) {
      const Eigen::Vector3f normal = as_eigen(direction_of(open.radiance, row, column));
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double all = 0;
      for (const SkySample& sample : samples) {
        const float cosine = as_eigen(sample.direction).dot(normal);
        if (cosine <= 0) continue;
        const double weight = double{sample.solid_angle * cosine};
        all += weight;
        sum += weight * as_eigen(sample.radiance).cast<double>();
      }
      open.radiance(row, column) = to_vector3((sum / all).cast<float>());
    }
  });
  return open;
}

SkyLight normalised(SkyLight sky) {
  Image<Vector3>& image = sky.radiance;
  const auto sine_squared = [&](int border) {
    const double sine = std::sin(std::max(pi / 2 - pi * border / image.height, 0.0));
    return sine * sine;
  };
  Eigen::Vector3d received = Eigen::Vector3d::Zero();
  for (int row = 0; row < image.height; ++row) {
    const double weight = (sine_squared(row) - sine_squared(row + 1)) / image.width;
    for (int column = 0; column < image.width; ++column)
      received += weight * as_eigen(image(row, column)).cast<double>();
  }
  const double mean = received.mean();
  if (mean == 0) return sky;
  for (Vector3& radiance : image.values)
    radiance = to_vector3((as_eigen(radiance).cast<double>() / mean).cast<float>());
  return sky;
}

}  // namespace heightlight
