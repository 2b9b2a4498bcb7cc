#pragma once

#include <vector>

#include "files/image_file.h"
#include "heightlight/surface.h"

namespace heightlight {

// Pictures for the eye: at most 512 texels a side, larger maps averaged over rectangles of texels (missing
// ones left out), sRGB encoded. Numbers belong in the float files.

/// What a texel without an answer looks like: a magenta that no grey and no shade comes near.
constexpr Rgb8 kMissingColour{136, 64, 120};

/// Of a linear value, cut to [0, 1] (IEC 61966-2-1).
std::uint8_t encode_srgb(float linear);

/// 0 black, 1 white; values outside are clipped, NaN is kMissingColour.
Image<Rgb8> grey_picture(const Map& map);

/// Likewise of one map (grey) or three of one size (red, green, blue).
Image<Rgb8> colour_picture(const std::vector<Map>& channels);

/// The relief lit from the upper left, 45° high.
Image<Rgb8> height_picture(const Surface& surface);

/// Pictures of one size beside each other, from left to right: bounce after bounce, as in the notes.
Image<Rgb8> picture_strip(const std::vector<Image<Rgb8>>& panels);

}  // namespace heightlight
