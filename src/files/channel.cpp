#include "files/channel.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "files/input_file.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

bool equal_names(const std::string& a, const std::string& b) {
  const auto equal = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

std::string join(const std::vector<std::string>& names, const std::vector<std::size_t>& indices,
                 const char* between) {
  std::string text;
  for (const std::size_t index : indices) text += (text.empty() ? "" : between) + names[index];
  return text;
}

std::vector<std::size_t> all_but_alpha(const std::vector<std::string>& channels) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels.size() == 1 || !(equal_names(channels[i], "A") || equal_names(channels[i], "alpha"))) {
      indices.push_back(i);
    }
  }
  return indices;
}

/// Whether the channels hold the same value at every texel (NaN is the same as NaN).
bool channels_agree(const StoredImage& image, const std::vector<std::size_t>& indices) {
  const auto agree = [&](const auto& samples) {
    const std::size_t stride = image.channels.size();
    for (std::size_t texel = 0; texel < samples.size(); texel += stride) {
      const auto first = samples[texel + indices[0]];
      for (const std::size_t index : indices) {
        const auto other = samples[texel + index];
        if (other != first && (other == other || first == first)) return false;
      }
    }
    return true;
  };
  return std::visit(agree, image.samples);
}

Image<double> copy_channel(const StoredImage& image, std::size_t index) {
  Image<double> values(image.width, image.height);
  const auto copy = [&](const auto& samples) {
    const std::size_t stride = image.channels.size();
    for (std::size_t i = 0; i < values.size(); ++i)
      values.values[i] = static_cast<double>(samples[i * stride + index]);
  };
  std::visit(copy, image.samples);
  return values;
}

}  // namespace

std::size_t find_channel(const std::filesystem::path& path, const std::vector<std::string>& channels,
                         const std::string& wanted) {
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (equal_names(channels[i], wanted)) return i;
  }
  std::size_t index = 0;
  const auto [stop, fault] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (fault == std::errc() && stop == wanted.data() + wanted.size() && index < channels.size()) return index;
  std::string names;
  for (const std::string& name : channels) names += (names.empty() ? "" : ", ") + name;
  throw UsageError(path.string() + ": has no channel '" + wanted + "'; it has " + names);
}

ChannelSamples pick_channel(const std::filesystem::path& path, const StoredImage& image,
                            const std::optional<std::string>& wanted) {
  if (wanted) {
    const std::size_t index = find_channel(path, image.channels, *wanted);
    return {copy_channel(image, index), image.channels[index]};
  }
  const std::vector<std::size_t> candidates = all_but_alpha(image.channels);
  if (candidates.empty())
    throw file_error(path, "has no channel but alpha; choose it by its name", "channel");
  if (candidates.size() == 1) return {copy_channel(image, candidates[0]), image.channels[candidates[0]]};
  if (!channels_agree(image, candidates)) {
    throw file_error(path,
                     "its channels " + join(image.channels, candidates, ", ") +
                         " differ, so it is not a height map as it stands; choose one of them",
                     "channel");
  }
  return {copy_channel(image, candidates[0]), "grey (" + join(image.channels, candidates, " = ") + ")"};
}

}  // namespace heightlight
