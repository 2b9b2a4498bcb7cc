#pragma once

#include <cstdint>
#include <optional>

#include "bake/baked_map.h"
#include "heightlight/image.h"

namespace heightlight {

/// How values become samples of a file.
struct TexelEncoding {
  TextureDepth depth = TextureDepth::uint16;
  std::optional<Image<float>> noise;  ///< thresholds of the dither, repeated over the map; else rounding
};

/// Of these options.
TexelEncoding make_encoding(const BakeOptions& options);

/// Largest level of integer samples; 0 of floats.
int largest_level(TextureDepth depth);

/// The sample of a value at (row, column) in the file's `channel`-th channel. Integers: the nearest level, as
/// a whole number, halves rounded up: 0 between −1 and 1 becomes 128 or 32768, so that a flat normal is (128,
/// 128, 255). Dithered: one of the two levels beside it, so that their mean is the value, but for that 0.
/// Floats: the value itself. What is to be sRGB is encoded so before it becomes a level.
float encode_texel(const TexelEncoding& encoding, const BakedChannel& channel, float value, int row,
                   int column, int channel_index);

}  // namespace heightlight
