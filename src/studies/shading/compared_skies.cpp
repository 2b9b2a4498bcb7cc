#include "shading/compared_skies.h"

#include <cmath>
#include <numbers>

#include "base/texel_algebra.h"
#include "skylight/sky_samples.h"

namespace heightlight {
namespace {

using std::numbers::pi;

constexpr int kSkyRows = 360;  // half a degree

/// The upper half by a function of elevation and azimuth, rad; dark below.
template <class Radiance>
SkyLight make_upper_sky(Radiance&& radiance) {
  SkyLight sky{Image<Vector3>(2 * kSkyRows, kSkyRows)};
  for (int row = 0; row < kSkyRows / 2; ++row) {
    for (int column = 0; column < sky.radiance.width; ++column) {
      const Vector3 d = direction_of(sky.radiance, row, column);
      const auto value = static_cast<float>(radiance(as_eigen(d).cast<double>().eval()));
      sky.radiance(row, column) = {value, value, value};
    }
  }
  return normalised(std::move(sky));
}

SkyLight low_sun_sky() {
  constexpr double kElevation = 12 * pi / 180;
  constexpr double kAzimuth = 35 * pi / 180;
  const Eigen::Vector3d sun(std::cos(kElevation) * std::cos(kAzimuth),
                            std::cos(kElevation) * std::sin(kAzimuth), std::sin(kElevation));
  return make_upper_sky([&](const Eigen::Vector3d& d) {
    return 0.3 + 0.7 * d.z() + 30 * std::exp(60 * (d.dot(sun) - 1));  // a glow of about 10°
  });
}

SkyLight binary_sky() {
  constexpr double kPatch = pi / 6;
  return make_upper_sky([&](const Eigen::Vector3d& d) {
    const auto up = static_cast<int>(std::floor(std::asin(d.z()) / kPatch));
    const auto around = static_cast<int>(std::floor((std::atan2(d.y(), d.x()) + pi) / kPatch));
    return (up + around) % 2 == 0 ? 1.0 : 0.0;
  });
}

}  // namespace

std::vector<NamedSky> compared_skies() {
  return {{"uniform", {Image<Vector3>(2, 1, {1, 1, 1})}},
          {"overcast", overcast_sky()},
          {"low-sun", low_sun_sky()},
          {"binary", binary_sky()}};
}

std::array<Harmonics, 3> project_sky(const SkyLight& sky) {
  std::array<Harmonics, 3> projected{};
  for (const SkySample& sample : sample_sky(sky, kSkyRows)) {
    const Harmonics y = harmonics_of(as_eigen(sample.direction).cast<double>());
    const auto angle = static_cast<double>(sample.solid_angle);
    for (std::size_t i = 0; i < y.size(); ++i) {
      projected[0].at(i) += angle * static_cast<double>(sample.radiance.x) * y.at(i);
      projected[1].at(i) += angle * static_cast<double>(sample.radiance.y) * y.at(i);
      projected[2].at(i) += angle * static_cast<double>(sample.radiance.z) * y.at(i);
    }
  }
  return projected;
}

}  // namespace heightlight
