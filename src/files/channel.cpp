#include "files/channel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/percentile.h"
#include "files/named.h"

namespace heightlight {
namespace {

bool is_alpha(const std::string& name) { return equal_names(name, "A") || equal_names(name, "alpha"); }

std::vector<std::size_t> all_but_alpha(const std::vector<std::string>& channels) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels.size() == 1 || !is_alpha(channels[i])) indices.push_back(i);
  }
  return indices;
}

std::string names_of(const StoredImage& image, const std::vector<std::size_t>& indices, const char* between) {
  std::vector<std::string> names;
  for (const std::size_t index : indices) names.push_back(image.channels[index]);
  return join_names(names, between);
}

/// The sample of a texel and channel, both counted from 0.
double sample_at(const StoredImage& image, std::size_t texel, std::size_t channel) {
  return std::visit(
      [&](const auto& samples) {
        return static_cast<double>(samples[texel * image.channels.size() + channel]);
      },
      image.samples);
}

/// 1 where alpha is 0; empty if there is no alpha, or if it is 0 nowhere or everywhere.
std::vector<char> find_holes(const StoredImage& image, std::size_t texels, ChannelSamples& picked) {
  const auto alpha = std::find_if(image.channels.begin(), image.channels.end(), is_alpha);
  if (image.channels.size() < 2 || alpha == image.channels.end()) return {};
  const auto channel = static_cast<std::size_t>(alpha - image.channels.begin());
  std::vector<char> holes(texels);
  std::size_t transparent = 0;
  for (std::size_t texel = 0; texel < texels; ++texel) {
    holes[texel] = sample_at(image, texel, channel) == 0 ? 1 : 0;
    transparent += static_cast<std::size_t>(holes[texel]);
  }
  if (transparent == texels) {
    picked.warnings.emplace_back("its alpha is 0 everywhere; it was not taken for transparency");
  } else if (transparent > 0) {
    picked.warnings.push_back(std::to_string(transparent) + " of its samples are transparent: missing");
    return holes;
  }
  return {};
}

/// Whether the channels have equal values at every texel outside the holes (two NaN count as equal).
bool channels_agree(const StoredImage& image, const std::vector<std::size_t>& indices,
                    const std::vector<char>& holes) {
  const auto agree = [&](const auto& samples) {
    const std::size_t stride = image.channels.size();
    for (std::size_t at = 0; at < samples.size(); at += stride) {
      if (!holes.empty() && holes[at / stride] != 0) continue;
      const auto first = samples[at + indices[0]];
      for (const std::size_t index : indices) {
        const auto other = samples[at + index];
        if (other != first && (other == other || first == first)) return false;
      }
    }
    return true;
  };
  return std::visit(agree, image.samples);
}

/// Whether heights seem to be coded in the digits of colours, the first channel being the highest digit
/// (Terrarium: R · 256 + G + B / 256; Mapbox: R · 65536 + G · 256 + B). Then the first channel hardly changes
/// from texel to texel, and the last one jumps.
bool looks_colour_coded(const StoredImage& image, const std::vector<std::size_t>& indices) {
  if (image.sample_type != "uint8" || indices.size() != 3 || image.width < 2) return false;
  std::vector<double> high;
  std::vector<double> low;
  std::vector<double> whole;
  const std::size_t texels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) - 1;
  const std::size_t stride = std::max<std::size_t>(1, texels / 4096);
  for (std::size_t texel = 0; texel < texels; texel += stride) {
    if ((texel + 1) % static_cast<std::size_t>(image.width) == 0) continue;
    const auto step = [&](std::size_t c) {
      return sample_at(image, texel + 1, indices[c]) - sample_at(image, texel, indices[c]);
    };
    high.push_back(std::abs(step(0)));
    low.push_back(std::abs(step(2)));
    whole.push_back(std::abs(step(0) * 65536 + step(1) * 256 + step(2)));
  }
  constexpr double kJumps = 8;
  const auto median = [](std::vector<double>& steps) { return percentile(std::span<double>(steps), 0.5); };
  return !high.empty() && median(high) == 0 && median(low) > kJumps && median(whole) < 65536.0 / 4;
}

[[noreturn]] void refuse_colours(const InputFile& file, const StoredImage& image,
                                 const std::vector<std::size_t>& indices) {
  const std::string differ = "its channels " + names_of(image, indices, ", ") + " differ, ";
  if (looks_colour_coded(image, indices)) {
    throw file.error(differ +
                     "and look like heights in the digits of a colour (Terrarium: R * 256 + G + B / 256 - "
                     "32768 m; Mapbox: (R * 65536 + G * 256 + B) / 10 - 10000 m); decode them into a float "
                     "TIFF, one channel alone is no height");
  }
  throw file.error(differ + "so it is not a height map as it stands; choose one of them", "channel");
}

Image<double> copy_channel(const StoredImage& image, std::size_t index, const std::vector<char>& holes) {
  Image<double> values(image.width, image.height);
  const auto copy = [&](const auto& samples) {
    const std::size_t stride = image.channels.size();
    for (std::size_t i = 0; i < values.size(); ++i)
      values.values[i] = static_cast<double>(samples[i * stride + index]);
  };
  std::visit(copy, image.samples);
  for (std::size_t i = 0; i < holes.size(); ++i) {
    if (holes[i] != 0) values.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
  return values;
}

}  // namespace

ChannelSamples pick_channel(const InputFile& file, const StoredImage& image,
                            const std::optional<std::string>& wanted) {
  ChannelSamples picked;
  if (wanted) {
    const std::size_t index = find_named("channel", file, image.channels, *wanted);
    picked.values = copy_channel(image, index, {});
    picked.name = image.channels[index];
    return picked;
  }
  const std::vector<std::size_t> candidates = all_but_alpha(image.channels);
  if (candidates.empty()) throw file.error("has no channel but alpha; choose it by its name", "channel");
  const auto texels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const std::vector<char> holes = find_holes(image, texels, picked);
  if (candidates.size() > 1 && !channels_agree(image, candidates, holes))
    refuse_colours(file, image, candidates);
  picked.values = copy_channel(image, candidates[0], holes);
  picked.name = candidates.size() == 1 ? image.channels[candidates[0]]
                                       : "grey (" + names_of(image, candidates, " = ") + ")";
  return picked;
}

}  // namespace heightlight
