#include "files/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <functional>

#include "files/interrupt.h"
#include "files/output_file.h"
#include "files/tiff_write.h"

namespace heightlight {
namespace {

/// Writes through OpenImageIO into our own stream, because OpenImageIO would ignore write errors.
void write_oiio(const std::filesystem::path& path, const char* format, const OIIO::ImageSpec& spec,
                const std::function<bool(OIIO::ImageOutput&)>& write_samples) {
  write_file(path, [&](std::FILE* stream) {
    OIIO::Filesystem::IOFile proxy(stream, OIIO::Filesystem::IOProxy::Write);
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output) throw output_error(path, std::string("no writer for ") + format);
    const bool taken = output->set_ioproxy(&proxy) && output->open(path.string(), spec);
    const bool written = taken && write_samples(*output);
    const std::string fault = output->geterror();
    const bool closed = output->close();
    // The error of a failed stream (no space left) is clearer than the library's message.
    if (std::ferror(stream)) return;
    if (!written || !closed) {
      throw output_error(path, fault.substr(0, fault.find('\n')));
    }
  });
}

std::vector<float> interleave(const std::vector<std::pair<std::string, const Map*>>& channels, int first_row,
                              int rows) {
  const Map& first = *channels.front().second;
  const std::size_t begin = first.index(first_row, 0);
  const std::size_t count = first.index(rows, 0);
  std::vector<float> samples(count * channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const float* source = channels[c].second->values.data() + begin;
    for (std::size_t i = 0; i < count; ++i) samples[i * channels.size() + c] = source[i];
  }
  return samples;
}

}  // namespace

void write_png16(const std::filesystem::path& path, const Image<std::uint16_t>& levels) {
  const OIIO::ImageSpec spec(levels.width, levels.height, 1, OIIO::TypeDesc::UINT16);
  write_oiio(path, "png", spec, [&](OIIO::ImageOutput& output) {
    return output.write_image(OIIO::TypeDesc::UINT16, levels.values.data());
  });
}

void write_float_image(const std::filesystem::path& path,
                       const std::vector<std::pair<std::string, const Map*>>& channels,
                       const std::vector<std::pair<std::string, std::string>>& attributes) {
  assert(!channels.empty());
  const Map& first = *channels.front().second;
  OIIO::ImageSpec spec(first.width, first.height, static_cast<int>(channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const auto& [name, map] : channels) {
    assert(map->width == first.width && map->height == first.height);
    spec.channelnames.push_back(name);
  }
  spec.attribute("compression", "zip");
  spec.attribute("DateTime",
                 "1970:01:01 00:00:00");  // the time of writing would make files differ from run to run
  for (const auto& [name, text] : attributes) spec.attribute(name, text);

  write_oiio(path, "openexr", spec, [&](OIIO::ImageOutput& output) {
    constexpr int kRowsAtATime = 256;  // a multiple of the 16 rows that EXR compresses together
    for (int row = 0; row < first.height; row += kRowsAtATime) {
      throw_if_interrupted();
      const int rows = std::min(kRowsAtATime, first.height - row);
      const std::vector<float> samples = interleave(channels, row, rows);
      if (!output.write_scanlines(row, row + rows, 0, OIIO::TypeDesc::FLOAT, samples.data())) return false;
    }
    return true;
  });
}

namespace {

constexpr int kTextureRows = 64;  // written at a time: a multiple of the 16 that EXR compresses together

OIIO::TypeDesc stored_type(SampleType type) {
  switch (type) {
    case SampleType::uint8:
      return OIIO::TypeDesc::UINT8;
    case SampleType::uint16:
      return OIIO::TypeDesc::UINT16;
    case SampleType::half:
      return OIIO::TypeDesc::HALF;
    case SampleType::real:
      break;
  }
  return OIIO::TypeDesc::FLOAT;
}

template <class Level>
bool write_levels(OIIO::ImageOutput& output, int first, int last, const OIIO::TypeDesc& type,
                  const std::vector<float>& samples) {
  std::vector<Level> levels(samples.size());
  std::transform(samples.begin(), samples.end(), levels.begin(),
                 [](float sample) { return static_cast<Level>(sample); });
  return output.write_scanlines(first, last, 0, type, levels.data());
}

}  // namespace

void write_texture(const std::filesystem::path& path, const TextureLayout& layout, const FillRows& fill) {
  const std::string extension = path.extension().string();
  if (extension == ".tif") return write_tiff(path, layout, fill);
  const char* format = extension == ".png" ? "png" : "openexr";
  const OIIO::TypeDesc type = stored_type(layout.type);
  OIIO::ImageSpec spec(layout.width, layout.height, static_cast<int>(layout.channels.size()), type);
  spec.channelnames = layout.channels;
  spec.alpha_channel = -1;
  spec.attribute("oiio:UnassociatedAlpha", 1);
  spec.attribute("compression", "zip");
  spec.attribute("png:compressionLevel", 4);  // a third of the default's time, for a tenth more bytes
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  for (const auto& [name, text] : layout.attributes) spec.attribute(name, text);
  write_oiio(path, format, spec, [&](OIIO::ImageOutput& output) {
    std::vector<float> samples;
    for (int row = 0; row < layout.height; row += kTextureRows) {
      const int rows = std::min(kTextureRows, layout.height - row);
      samples.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(layout.width) *
                     layout.channels.size());
      fill(row, rows, samples.data());
      const bool written =
          layout.type == SampleType::uint8
              ? write_levels<std::uint8_t>(output, row, row + rows, type, samples)
          : layout.type == SampleType::uint16
              ? write_levels<std::uint16_t>(output, row, row + rows, type, samples)
              : output.write_scanlines(row, row + rows, 0, OIIO::TypeDesc::FLOAT, samples.data());
      if (!written) return false;
    }
    return true;
  });
}

std::uint64_t texture_writing_bytes(int width, std::uint64_t channels, bool tiff) {
  // Samples as float and as levels, and the library's copy of both; for TIFF, the tiles and the rows from
  // which the coarsest overview is made, which are no more than a tile's.
  constexpr std::uint64_t kCopies = 2 * (sizeof(float) + sizeof(std::uint16_t));
  constexpr std::uint64_t kCompressor = 1 << 20;
  const std::uint64_t samples = static_cast<std::uint64_t>(width) * channels;
  return kCompressor +
         (tiff ? 2 * kTiffTile * samples * sizeof(float) : std::uint64_t{kTextureRows} * samples * kCopies);
}

}  // namespace heightlight
