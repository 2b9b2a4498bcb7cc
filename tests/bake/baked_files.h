#pragma once

#include <OpenImageIO/imageio.h>

// stb's decoder once more: the library keeps its own to itself.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "scratch_folder.h"

namespace heightlight {

/// Samples of a texture, as whole levels (integers) or as they are (floats).
struct ReadTexture {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> samples;

  float at(int row, int column, int channel) const {
    return samples[static_cast<std::size_t>((row * width + column) * channels + channel)];
  }
  friend bool operator==(const ReadTexture&, const ReadTexture&) = default;
};

inline ReadTexture read_by_oiio(const std::filesystem::path& path) {
  OIIO::ImageSpec hint;
  hint.attribute("oiio:UnassociatedAlpha", 1);
  const auto file = OIIO::ImageInput::open(path.string(), &hint);
  REQUIRE(file);
  const OIIO::ImageSpec& spec = file->spec();
  ReadTexture texture{spec.width, spec.height, spec.nchannels, {}};
  texture.samples.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  REQUIRE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texture.samples.data()));
  const float levels = spec.format == OIIO::TypeDesc::UINT8    ? 255.0F
                       : spec.format == OIIO::TypeDesc::UINT16 ? 65535.0F
                                                               : 1.0F;
  if (levels > 1) {
    for (float& sample : texture.samples) sample = std::round(sample * levels);
  }
  return texture;
}

/// A PNG of either depth.
inline ReadTexture read_by_stb(const std::filesystem::path& path) {
  ReadTexture texture;
  const auto take = [&](auto* samples) {
    REQUIRE(samples);
    texture.samples.assign(samples, samples + texture.width * texture.height * texture.channels);
    stbi_image_free(samples);
  };
  if (stbi_is_16_bit(path.c_str())) {
    take(stbi_load_16(path.c_str(), &texture.width, &texture.height, &texture.channels, 0));
  } else {
    take(stbi_load(path.c_str(), &texture.width, &texture.height, &texture.channels, 0));
  }
  return texture;
}

inline nlohmann::json read_sidecar(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_text(folder / "m_bake.json"));
}

/// Bakes a map under the name "m"; the warnings.
inline std::vector<Warning> bake_map(const Heightmap& map, const BakeOptions& options,
                                     const std::filesystem::path& folder) {
  LoadedHeightmap loaded;
  loaded.map = map;
  return bake_material(std::move(loaded), options,
                       {.source = "m.exr", .inputs = {"m.exr"}, .folder = folder, .name = "m"})
      .warnings;
}

}  // namespace heightlight
