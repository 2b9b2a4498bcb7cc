#pragma once

#include <cstddef>
#include <limits>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/srgb.h"
#include "files/image_read.h"

namespace heightlight {

/// One channel of an image. Integer samples are divided by the largest value of their type, and subtracted
/// from 1 in a TIFF whose white is zero; float samples stay as they are. With `from_srgb`, values are decoded
/// from sRGB to linear.
template <class Value>
std::vector<Value> decode_channel(const StoredImage& image, std::size_t channel, bool from_srgb) {
  const std::size_t stride = image.channels.size();
  const bool dark = image.tiff && image.tiff->white_is_zero;  // larger numbers are darker
  return std::visit(
      [&](const auto& samples) {
        using Sample = typename std::decay_t<decltype(samples)>::value_type;
        constexpr double kWhite = static_cast<double>(std::numeric_limits<Sample>::max());
        std::vector<Value> values(samples.size() / stride);
        for (std::size_t i = 0; i < values.size(); ++i) {
          auto value = static_cast<double>(samples[i * stride + channel]);
          if (std::is_integral_v<Sample>) value = dark ? 1 - value / kWhite : value / kWhite;
          values[i] = static_cast<Value>(from_srgb ? srgb_to_linear(value) : value);
        }
        return values;
      },
      image.samples);
}

}  // namespace heightlight
