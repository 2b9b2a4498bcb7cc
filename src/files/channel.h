#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "files/image_read.h"
#include "heightlight/image.h"

namespace heightlight {

/// The samples of one channel, and what to call it.
struct ChannelSamples {
  Image<double> values;
  std::string name;  ///< "Y", "R", or "grey (R = G = B)"
};

/// Takes the channel that `wanted` names (any case) or counts (from 0); by default the only one, or grey
/// where all but alpha agree at every texel. Throws Error naming `path` where they differ, UsageError where
/// `wanted` is not there.
ChannelSamples pick_channel(const std::filesystem::path& path, const StoredImage& image,
                            const std::optional<std::string>& wanted);

/// Index of the channel that `wanted` names or counts. Throws UsageError naming `path` and the channels.
std::size_t find_channel(const std::filesystem::path& path, const std::vector<std::string>& channels,
                         const std::string& wanted);

}  // namespace heightlight
