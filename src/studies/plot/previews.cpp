#include "plot/previews.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/srgb.h"
#include "base/texel_algebra.h"

namespace heightlight {
namespace {

constexpr int kLargestSide = 512;
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// First source sample of the i-th of `to` parts of `from` samples.
int part_begin(int i, int from, int to) { return static_cast<int>(std::int64_t{i} * from / to); }

/// Mean of the values present in a rectangle of texels; NaN where none is.
float mean_of(const Map& map, int row_begin, int row_end, int column_begin, int column_end) {
  double sum = 0;
  int count = 0;
  for (int row = row_begin; row < row_end; ++row) {
    for (int column = column_begin; column < column_end; ++column) {
      const float value = map(row, column);
      if (std::isnan(value)) continue;
      sum += static_cast<double>(value);
      ++count;
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : kMissing;
}

Map shrink(const Map& map) {
  const int largest = std::max(map.width, map.height);
  if (largest <= kLargestSide) return map;
  const auto scaled = [largest](int side) {
    return std::max(1, static_cast<int>(std::lround(static_cast<double>(side) * kLargestSide / largest)));
  };
  Map small(scaled(map.width), scaled(map.height));
  for (int row = 0; row < small.height; ++row) {
    for (int column = 0; column < small.width; ++column) {
      small(row, column) = mean_of(
          map, part_begin(row, map.height, small.height), part_begin(row + 1, map.height, small.height),
          part_begin(column, map.width, small.width), part_begin(column + 1, map.width, small.width));
    }
  }
  return small;
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
