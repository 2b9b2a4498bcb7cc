#include <algorithm>
#include <cmath>
#include <string>

#include "cli/pack_options.h"
#include "cli/pack_text.h"
#include "files/decoded_channel.h"
#include "files/image_file.h"
#include "files/image_read.h"
#include "files/input_file.h"
#include "files/named.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " × " + std::to_string(height);
}

/// Whether two channels hold the same everywhere.
bool are_equal(const StoredImage& image, std::size_t a, std::size_t b) {
  return std::visit(
      [&](const auto& samples) {
        const std::size_t stride = image.channels.size();
        for (std::size_t i = 0; i < samples.size(); i += stride) {
          if (samples[i + a] != samples[i + b]) return false;
        }
        return true;
      },
      image.samples);
}

/// The channel that is meant: where none was chosen, the first, if all but alpha are equal.
std::size_t channel_index(const InputFile& file, const StoredImage& image, const std::string& channel) {
  if (!channel.empty()) return find_named("channel", file, image.channels, channel);
  for (std::size_t i = 1; i < image.channels.size(); ++i) {
    if (equal_names(image.channels[i], "A") || are_equal(image, 0, i)) continue;
    throw file.error("its channels " + join_names(image.channels) + " differ: choose one, such as " +
                     file.path().filename().string() + ":" + image.channels[0]);
  }
  return 0;
}

StoredImage read_own_image(const InputFile& file, const Heightmap& map, std::uint64_t memory) {
  const FileFormat format = recognise_format(file);
  if (!is_picture(format))
    throw file.error(std::string("is of the kind ") + to_string(format) + "; a pack needs images");
  StoredImage image = read_image(file, format, memory);
  if (image.width != map.height.width || image.height != map.height.height)
    throw file.error("has " + size_text(image.width, image.height) + " texels, but the heightmap has " +
                     size_text(map.height.width, map.height.height));
  return image;
}

/// Of an image: shares, which may be missing where heights are.
Map read_values(const InputFile& file, const StoredImage& image, const OwnChannel& own, const Map& heights) {
  const std::size_t channel = channel_index(file, image, own.channel);
  Map values(image.width, image.height);
  values.values = decode_channel<float>(image, channel, own.is_srgb);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float value = values.values[i];
    const bool is_missing = std::isnan(value) && std::isnan(heights.values[i]);
    if (!is_missing && !(value >= 0 && value <= 1)) throw file.error("has samples outside [0, 1]");
  }
  return values;
}

}  // namespace

std::vector<OwnChannel> own_channels_for(const BakeOptions& options, const std::filesystem::path& map) {
  std::vector<OwnChannel> channels = options.own;
  for (OwnChannel& own : channels) own.path = path_for_map(own.path.string(), map);
  return channels;
}

void read_own_channels(std::vector<OwnChannel>& channels, const Heightmap& map, std::uint64_t memory) {
  const std::uint64_t held = map.height.size() * sizeof(float) * (1 + channels.size());
  const std::uint64_t free = memory - std::min(memory, held);
  for (const OwnChannel& first : channels) {
    if (!first.values.values.empty()) continue;  // read with another channel of its file
    const InputFile file(first.path);
    const StoredImage image = read_own_image(file, map, free);
    const std::string sha256 = sha256_of_file(file);
    for (OwnChannel& own : channels) {
      if (own.path != first.path) continue;
      own.values = read_values(file, image, own, map.height);
      own.sha256 = sha256;
    }
    file.check_unchanged();
  }
}

void find_checksums(std::vector<OwnChannel>& channels) {
  for (OwnChannel& own : channels) own.sha256 = sha256_of_file(InputFile(own.path));
}

}  // namespace heightlight
