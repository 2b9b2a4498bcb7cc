#include "plot/lit_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

constexpr double kPi = std::numbers::pi;

/// Bilinear, repeated; u and v in [0, 1) from the upper left.
double sample(const Map& map, double u, double v) {
  const double x = (u - std::floor(u)) * map.width - 0.5;
  const double y = (v - std::floor(v)) * map.height - 0.5;
  const int column = static_cast<int>(std::floor(x));
  const int row = static_cast<int>(std::floor(y));
  const auto wrapped = [](int i, int count) { return (i + count) % count; };
  const auto texel = [&](int i, int j) {
    return double{map(wrapped(row + i, map.height), wrapped(column + j, map.width))};
  };
  const double right = x - column;
  const double down = y - row;
  return (1 - down) * ((1 - right) * texel(0, 0) + right * texel(0, 1)) +
         down * ((1 - right) * texel(1, 0) + right * texel(1, 1));
}

/// Radiance over that of a white plane under the sky alone, of red, green and blue, at a place of the disk of
/// radius 1.
std::array<double, 3> shade(const SphereSkin& skin, double x, double y) {
  static const Eigen::Vector3d kLamp = Eigen::Vector3d(-0.55, 0.6, 0.58).normalized();
  constexpr double kSky = 0.5;
  constexpr double kLampStrength = 1.1;
  const Eigen::Vector3d n(x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y)));
  const double longitude = std::atan2(n.x(), n.z());
  const double latitude = std::asin(std::clamp(n.y(), -1.0, 1.0));
  const double u = longitude * 2 / kPi;
  const double v = -latitude * 2 / kPi / skin.proportion;
  const Eigen::Vector3d tangent(std::cos(longitude), 0, -std::sin(longitude));
  const Eigen::Vector3d bitangent(n.y() * tangent.z(), n.z() * tangent.x() - n.x() * tangent.z(),
                                  -n.y() * tangent.x());  // n × tangent, whose y is 0
  const Eigen::Vector3d normal = (sample(skin.normal_x, u, v) * tangent +
                                  sample(skin.normal_y, u, v) * bitangent + sample(skin.normal_z, u, v) * n)
                                     .normalized();
  const double lamp = kLampStrength * sample(skin.occlusion, u, v) * std::max(0.0, normal.dot(kLamp));
  std::array<double, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c)
    colour[c] = sample(skin.reflected[skin.reflected.size() == 1 ? 0 : c], u, v) *
                (kSky * (0.75 + 0.25 * normal.y()) + lamp);
  return colour;
}

}  // namespace

Image<Rgb8> lit_sphere(const SphereSkin& skin, int side, const Rgb8& ground) {
  constexpr int kSamples = 3;  // a side, per pixel
  Image<Rgb8> picture(side, side, ground);
  parallel_for(side, [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    for (int column = 0; column < side; ++column) {
      std::array<double, 3> sum{};
      int inside = 0;
      for (int s = 0; s < kSamples * kSamples; ++s) {
        const int across = s % kSamples;
        const int down = s / kSamples;
        const double x = 2 * ((column + (across + 0.5) / kSamples) / side - 0.5);
        const double y = -2 * ((row + (down + 0.5) / kSamples) / side - 0.5);
        if (x * x + y * y >= 1) continue;
        const std::array<double, 3> colour = shade(skin, x, y);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
        ++inside;
      }
      if (inside == 0) continue;
      const double cover = static_cast<double>(inside) / (kSamples * kSamples);
      for (std::size_t c = 0; c < 3; ++c) {
        const bool is_missing = std::isnan(sum[c]);
        const double level =
            is_missing ? kMissingColour[c] : encode_srgb(static_cast<float>(sum[c] / inside));
        picture(row, column)[c] =
            static_cast<std::uint8_t>(std::lround(cover * level + (1 - cover) * ground[c]));
      }
    }
  });
  return picture;
}

}  // namespace heightlight
