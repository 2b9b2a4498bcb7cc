#include <algorithm>
#include <array>

#include "files/image_read.h"
#include "files/named.h"
#include "heightlight/error.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

/// Indices of red, green and blue among the channels; for a grey image, all are the same.
std::array<std::size_t, 3> find_colours(const InputFile& file, const std::vector<std::string>& channels) {
  if (channels.size() <= 2 && !channels.empty()) return {0, 0, 0};  // grey, possibly with alpha
  constexpr std::array<const char*, 3> kColours{"R", "G", "B"};
  std::array<std::size_t, 3> places{};
  for (std::size_t c = 0; c < places.size(); ++c) {
    const auto found = std::find_if(channels.begin(), channels.end(), [&](const std::string& name) {
      return equal_names(name, kColours.at(c));
    });
    if (found == channels.end()) throw file.error("has no channels R, G and B, but " + join_names(channels));
    places.at(c) = static_cast<std::size_t>(found - channels.begin());
  }
  return places;
}

}  // namespace

SkyLight load_sky_light(const std::filesystem::path& path, std::uint64_t memory) {
  const InputFile file(path);
  const FileFormat format = recognise_format(file);
  if (!is_picture(format))
    throw file.error(std::string("is of the kind ") + to_string(format) +
                     ", which is no sky; use an EXR or HDR image");
  const StoredImage image = read_image(file, format, memory);
  if (image.is_integer)
    throw file.error("a sky wants radiance, as EXR and HDR images have it, not levels of " +
                     std::to_string(image.bits) + " bits");
  const std::array<std::size_t, 3> places = find_colours(file, image.channels);
  SkyLight sky{Image<Vector3>(image.width, image.height)};
  std::visit(
      [&](const auto& samples) {
        const std::size_t stride = image.channels.size();
        const auto at = [&](std::size_t i, std::size_t c) {
          return static_cast<float>(samples[i * stride + places.at(c)]);
        };
        for (std::size_t i = 0; i < sky.radiance.size(); ++i)
          sky.radiance.values[i] = {at(i, 0), at(i, 1), at(i, 2)};
      },
      image.samples);
  try {
    check_sky_light(sky);
  } catch (const UsageError& error) {
    throw file.error(error.what());
  }
  file.check_unchanged();
  return sky;
}

}  // namespace heightlight
