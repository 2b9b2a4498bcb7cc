#include "bake/texture_write.h"

#include "base/parallel.h"
#include "files/esri_grid_write.h"

namespace heightlight {
namespace {

SampleType sample_type(TextureDepth depth) {
  switch (depth) {
    case TextureDepth::uint8:
      return SampleType::uint8;
    case TextureDepth::uint16:
      return SampleType::uint16;
    case TextureDepth::half:
      return SampleType::half;
    case TextureDepth::real:
      break;
  }
  return SampleType::real;
}

std::vector<std::string> channel_names(const BakedTexture& texture) {
  static const std::vector<std::string> kColour{"R", "G", "B", "A"};
  const std::size_t count = texture.channels.size();
  if (count == 1) return {"Y"};
  if (count <= 4) return {kColour.begin(), kColour.begin() + static_cast<std::ptrdiff_t>(count)};
  std::vector<std::string> names;
  const std::size_t digits = count <= 100 ? 100 : 1000;
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(std::to_string(digits + i));
    names.back().front() = 'c';  // in place: g++ 12 warns falsely of "c" + a string that ends here
  }
  return names;
}

/// What a GeoTIFF says of its bands.
std::vector<BandText> band_texts(const BakedTexture& texture) {
  std::vector<BandText> bands;
  for (const BakedChannel& channel : texture.channels)
    bands.push_back({.description = channel.quantity, .unit = channel.unit == "1" ? "" : channel.unit});
  return bands;
}

/// A map's samples as its file holds them. All arguments must outlive them.
FillRows encoded_rows(const BakedTexture& texture, const FillRows& values, int width,
                      const TexelEncoding& encoding) {
  return [&texture, &values, width, &encoding](int first, int rows, float* samples) {
    values(first, rows, samples);
    const auto count = static_cast<int>(texture.channels.size());
    parallel_for(rows, [&](std::int64_t line) {
      const int row = first + static_cast<int>(line);
      float* sample = samples + line * width * count;
      for (int column = 0; column < width; ++column) {
        for (int c = 0; c < count; ++c, ++sample)
          *sample =
              encode_texel(encoding, texture.channels[static_cast<std::size_t>(c)], *sample, row, column, c);
      }
    });
  };
}

}  // namespace

const char* extension_of(TextureFormat format) {
  switch (format) {
    case TextureFormat::png:
      return ".png";
    case TextureFormat::exr:
      return ".exr";
    case TextureFormat::tif:
      return ".tif";
    case TextureFormat::asc:
      break;
  }
  return ".asc";
}

FillRows values_of(const BakedTexture& texture, int width) {
  return [&texture, width](int first, int rows, float* samples) {
    const std::size_t count = texture.channels.size();
    parallel_for(rows, [&](std::int64_t line) {
      const auto texels = static_cast<std::size_t>(width);
      float* out = samples + static_cast<std::size_t>(line) * texels * count;
      const std::size_t begin = static_cast<std::size_t>(first + line) * texels;
      for (std::size_t i = begin; i < begin + texels; ++i) {
        for (const BakedChannel& channel : texture.channels) *out++ = channel.value(i);
      }
    });
  };
}

void write_baked(const std::filesystem::path& path, const BakedTexture& texture, const FillRows& values,
                 const TexelEncoding& encoding, const BakedMap& map) {
  const TextureLayout layout{.width = map.header.height.width,
                             .height = map.header.height.height,
                             .channels = channel_names(texture),
                             .type = sample_type(encoding.depth),
                             .attributes = {{"ImageDescription", texture.definition}},
                             .place = map.place ? &*map.place : nullptr,
                             .bands = band_texts(texture)};
  const FillRows rows = encoded_rows(texture, values, layout.width, encoding);
  if (path.extension() == ".asc") return write_esri_grid(path, layout, map.header.spacing, rows);
  write_texture(path, layout, rows);
}

}  // namespace heightlight
