#include "plot/previews.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/area_mean.h"
#include "base/srgb.h"
#include "base/texel_algebra.h"

namespace heightlight {
namespace {

constexpr int kLargestSide = 512;

Map shrink(const Map& map) {
  const int largest = std::max(map.width, map.height);
  if (largest <= kLargestSide) return map;
  const auto scaled = [largest](int side) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(side) * kLargestSide / largest)));
  };
  return area_mean(map, scaled(map.width), scaled(map.height));
}

}  // namespace

std::uint8_t encode_srgb(float linear) {
  const auto share = static_cast<double>(std::clamp(linear, 0.0F, 1.0F));
  return static_cast<std::uint8_t>(std::lround(255 * linear_to_srgb(share)));
}

Image<Rgb8> colour_picture(const std::vector<Map>& channels) {
  assert(channels.size() == 1 || channels.size() == 3);
  std::vector<Map> small;
  for (const Map& channel : channels) small.push_back(shrink(channel));
  Image<Rgb8> picture(small.front().width, small.front().height, kMissingColour);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (std::isnan(small.front().values[i])) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      picture.values[i][c] = encode_srgb(small[small.size() == 1 ? 0 : c].values[i]);
    }
  }
  return picture;
}

Image<Rgb8> grey_picture(const Map& map) { return colour_picture({map}); }

Image<Rgb8> height_picture(const Surface& surface) {
  const Eigen::Vector3f light = Eigen::Vector3f(-1, 1, std::sqrt(2.0F)).normalized();
  Map shade(surface.width(), surface.height());
  for (std::size_t i = 0; i < shade.size(); ++i) {
    const float cosine = as_eigen(surface.normal.values[i]).dot(light);
    shade.values[i] = 0.25F * (1 + cosine) * (1 + cosine);  // NaN stays; steep slopes keep some light
  }
  return grey_picture(shade);
}

Image<Rgb8> picture_strip(const std::vector<Image<Rgb8>>& panels) {
  constexpr int kGap = 8;
  constexpr Rgb8 kWhite{255, 255, 255};
  if (panels.empty()) return {};
  const int width = panels.front().width;
  const int height = panels.front().height;
  const int count = static_cast<int>(panels.size());
  Image<Rgb8> strip(count * width + (count - 1) * kGap, height, kWhite);
  for (int i = 0; i < count; ++i) {
    const Image<Rgb8>& panel = panels[static_cast<std::size_t>(i)];
    for (int row = 0; row < height; ++row) {
      std::copy_n(panel.values.begin() + static_cast<std::ptrdiff_t>(panel.index(row, 0)), width,
                  strip.values.begin() + static_cast<std::ptrdiff_t>(strip.index(row, i * (width + kGap))));
    }
  }
  return strip;
}

}  // namespace heightlight
