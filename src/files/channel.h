#pragma once

#include <optional>
#include <string>

#include "files/image_read.h"
#include "heightlight/image.h"

namespace heightlight {

/// The samples of one channel, and what to call it.
struct ChannelSamples {
  Image<double> values;  ///< NaN where transparent
  std::string name;      ///< "Y", "R", or "grey (R = G = B)"
  std::vector<std::string> warnings = {};
};

/// Takes the channel that `wanted` names (any case) or counts (from 0). Without `wanted`, takes the only
/// channel other than alpha, or grey where all such channels agree at every texel that is not transparent;
/// texels with alpha 0 are then missing (NaN), unless alpha is 0 everywhere. Beside a chosen channel, alpha
/// is ignored, because it may mean anything. Throws Error naming the file where the channels differ, and
/// UsageError where `wanted` does not exist.
ChannelSamples pick_channel(const InputFile& file, const StoredImage& image,
                            const std::optional<std::string>& wanted);

}  // namespace heightlight
