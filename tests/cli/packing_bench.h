#pragma once

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "command.h"
#include "results.h"
#include "write_samples.h"

namespace heightlight {

constexpr int kBenchSide = 32;
constexpr std::size_t kBenchTexels = std::size_t{kBenchSide} * kBenchSide;

/// ChannelLevels of one channel, or what they should be.
struct ChannelLevels {
  std::vector<int> values;

  friend bool operator==(const ChannelLevels&, const ChannelLevels&) = default;
  friend std::ostream& operator<<(std::ostream& out, const ChannelLevels& levels) {  // the first tell enough
    for (std::size_t i = 0; i < std::min<std::size_t>(levels.values.size(), 16); ++i)
      out << levels.values[i] << ' ';
    return out << "…";
  }
};

/// Of an image of integers.
inline ChannelLevels levels_of(const std::filesystem::path& path, std::size_t channel) {
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  const auto file = OIIO::ImageInput::open(path.string(), &as_stored);
  REQUIRE(file);
  const OIIO::ImageSpec& spec = file->spec();
  const bool is_8_bit = spec.format == OIIO::TypeDesc::UINT8;
  REQUIRE((is_8_bit || spec.format == OIIO::TypeDesc::UINT16));
  const auto stride = static_cast<std::size_t>(spec.nchannels);
  REQUIRE(channel < stride);
  std::vector<std::uint16_t> samples(spec.image_pixels() * stride);
  std::vector<std::uint8_t> bytes(samples.size());
  if (is_8_bit) {
    REQUIRE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, bytes.data()));
    std::copy(bytes.begin(), bytes.end(), samples.begin());
  } else {
    REQUIRE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT16, samples.data()));
  }
  ChannelLevels levels;
  for (std::size_t i = channel; i < samples.size(); i += stride) levels.values.push_back(samples[i]);
  return levels;
}

inline std::vector<std::string> channels_of(const std::filesystem::path& path) {
  return read_picture(path).channels;
}

/// 8-bit levels, all of them, in an order that `step` says.
inline std::vector<std::uint8_t> ramp(std::size_t step) {
  std::vector<std::uint8_t> levels;
  for (std::size_t i = 0; i < kBenchTexels; ++i) levels.push_back(static_cast<std::uint8_t>(i * step));
  return levels;
}

template <class T>
ChannelLevels as_levels(const std::vector<T>& samples) {
  return {{samples.begin(), samples.end()}};
}

inline ChannelLevels inverted(ChannelLevels levels, int largest) {
  for (int& level : levels.values) level = largest - level;
  return levels;
}

inline void write_grey(const ScratchFolder& folder, const std::string& name,
                       const std::vector<std::uint8_t>& levels) {
  write_samples(folder / name, kBenchSide, kBenchSide, {"Y"}, levels);
}

/// A folder with brick_height.png, brick_rough.png, brick_metal.png, and three channels in rgb.png.
struct PackingBench {
  ScratchFolder folder;
  std::vector<std::uint8_t> rough = ramp(1);
  std::vector<std::uint8_t> metal = ramp(7);
  std::vector<std::uint8_t> rgb;

  PackingBench() {
    REQUIRE(run_command("synth brick -o brick_height.png --size " + std::to_string(kBenchSide), folder)
                .exit_code == 0);
    write_grey(folder, "brick_rough.png", rough);
    write_grey(folder, "brick_metal.png", metal);
    for (std::size_t i = 0; i < 3 * kBenchTexels; ++i) rgb.push_back(static_cast<std::uint8_t>(i * 11));
    write_samples(folder / "rgb.png", kBenchSide, kBenchSide, {"R", "G", "B"}, rgb);
  }

  void bake(const std::string& arguments) const {
    const CommandResult run = run_command("bake --azimuths 8 --quiet -o out " + arguments, folder);
    INFO(arguments << "\n" << run.error);
    REQUIRE(run.exit_code == 0);
  }

  ChannelLevels levels(const std::string& file, std::size_t channel) const {
    return levels_of(folder / "out" / file, channel);
  }

  ChannelLevels rgb_channel(std::size_t channel) const {
    ChannelLevels levels;
    for (std::size_t i = channel; i < rgb.size(); i += 3) levels.values.push_back(rgb[i]);
    return levels;
  }
};

}  // namespace heightlight
