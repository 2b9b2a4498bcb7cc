#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "bake/material.h"

namespace heightlight {

/// One channel of a texture: its values, texel by texel, and what they mean.
struct BakedChannel {
  std::string quantity;  ///< "sky view factor", "x", …
  std::string unit;      ///< "1", "rad"
  double low = 0;        ///< the value that integer files store as 0
  double high = 1;       ///< and the one that they store as their largest level; values beyond are clipped
  double missing = 1;    ///< what stands for a missing sample in integer files
  std::function<float(std::size_t)> value;  ///< of a texel; NaN where the sample is missing
  bool is_srgb = false;                     ///< integers hold the share between low and high sRGB encoded
};

/// One file.
struct BakedTexture {
  std::string suffix;  ///< NAME_suffix.png
  std::string definition;
  std::vector<BakedChannel> channels;
};

/// The components of a map; `material`, which they read, must outlive them. At least one.
std::vector<BakedChannel> baked_channels(MaterialMap map, const Material& material,
                                         const BakeOptions& options);

/// A value in [0, 1] for every texel, of no map.
BakedChannel constant_channel(double value);

/// Components that a map has, without finding it; under a light of one's own, as many as it may have.
int component_count(MaterialMap map, const BakeOptions& options);

/// All files of a material. PNG holds four channels at most: maps that have more are spread over several
/// files, and two channels get a third, empty one.
std::vector<BakedTexture> baked_textures(const Material& material, const BakeOptions& options);

/// Channels that all of them have together, without finding anything.
std::size_t texture_channels(const BakeOptions& options);

/// Their suffixes, without finding anything.
std::vector<std::string> texture_suffixes(const BakeOptions& options);

}  // namespace heightlight
