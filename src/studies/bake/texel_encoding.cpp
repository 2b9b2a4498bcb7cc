#include "bake/texel_encoding.h"

#include <algorithm>
#include <cmath>

#include "bake/blue_noise.h"
#include "base/srgb.h"

namespace heightlight {
namespace {

/// Directions that sum to 0 do so to a few roundings. That must not decide which way a half is rounded.
constexpr double kRounding = 0x1p-8;  // levels
constexpr double kZero = 1e-6;        // of values between −1 and 1

/// Each channel reads the square of thresholds from another place, so that they are not correlated.
float threshold(const Image<float>& noise, int row, int column, int channel) {
  return noise((row + 23 * channel) % noise.height, (column + 41 * channel) % noise.width);
}

}  // namespace

TexelEncoding make_encoding(const BakeOptions& options) {
  TexelEncoding encoding{options.depth, {}};
  if (options.dither) encoding.noise = make_blue_noise(kDitherSide, options.seed);
  return encoding;
}

int largest_level(TextureDepth depth) {
  return depth == TextureDepth::uint8 ? 255 : depth == TextureDepth::uint16 ? 65535 : 0;
}

float encode_texel(const TexelEncoding& encoding, const BakedChannel& channel, float value, int row,
                   int column, int channel_index) {
  const int levels = largest_level(encoding.depth);
  if (levels == 0) return value;
  const double present = std::isnan(value) ? channel.missing : static_cast<double>(value);
  const double linear = std::clamp((present - channel.low) / (channel.high - channel.low), 0.0, 1.0);
  const double share = channel.is_srgb ? linear_to_srgb(linear) : linear;
  const bool is_zero = channel.low < 0 && std::fabs(present) < kZero;
  if (encoding.noise && !is_zero) {
    const auto up = static_cast<double>(threshold(*encoding.noise, row, column, channel_index));
    return static_cast<float>(std::min(std::floor(share * levels + up), static_cast<double>(levels)));
  }
  return static_cast<float>(
      std::min(std::floor(share * levels + 0.5 + kRounding), static_cast<double>(levels)));
}

}  // namespace heightlight
