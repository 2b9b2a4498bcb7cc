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

/// Takes the channel that `wanted` names (any case) or counts (from 0); by default the only one, or grey
/// where all but alpha agree at every texel that is not transparent. Alpha 0 is then a hole, unless all of it
/// is 0; beside a channel that was chosen, it may mean anything. Throws Error naming the file where channels
/// differ, UsageError where `wanted` is not there.
ChannelSamples pick_channel(const InputFile& file, const StoredImage& image,
                            const std::optional<std::string>& wanted);

}  // namespace heightlight
