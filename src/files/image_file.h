#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "files/input_file.h"
#include "heightlight/georeference.h"
#include "heightlight/image.h"

namespace heightlight {

/// An 8-bit RGB colour, sRGB encoded, as pictures hold it.
using Rgb8 = std::array<std::uint8_t, 3>;

/// Each writer replaces `path`, and throws Error naming the file and the fault (full disk, unwritable
/// folder).

/// Writes an 8-bit sRGB picture, through stb.
void write_png(const std::filesystem::path& path, const Image<Rgb8>& picture);

/// Writes a 16-bit grey PNG with the given levels.
void write_png16(const std::filesystem::path& path, const Image<std::uint16_t>& levels);

/// Writes a float32 EXR with one map per named channel ("Y", or "R", "G", "B"); all maps have one size.
/// `attributes` are text attributes of the header. NaN is kept.
void write_float_image(const std::filesystem::path& path,
                       const std::vector<std::pair<std::string, const Map*>>& channels,
                       const std::vector<std::pair<std::string, std::string>>& attributes = {});

/// How samples are stored.
enum class SampleType { uint8, uint16, half, real };

/// What the metadata of a GeoTIFF say about one band.
struct BandText {
  std::string description = {};
  std::string unit = {};
};

/// The layout of a texture file.
struct TextureLayout {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels = {};  ///< "Y", or "R", "G", …; a channel named "A" is data, not coverage
  SampleType type = SampleType::uint16;
  std::vector<std::pair<std::string, std::string>> attributes = {};  ///< text, where the format has it
  const Georeference* place = nullptr;  ///< of a TIFF: where on earth it lies; may be null
  std::vector<BandText> bands = {};     ///< of a georeferenced TIFF: one entry per channel, or none
};

/// Fills rows [first, first + count) with samples, channels interleaved; integer formats take whole levels.
using FillRows = std::function<void(int first, int count, float* samples)>;

/// Writes a PNG, EXR or TIFF, chosen by the extension, a few rows at a time. Values are stored as they are:
/// linear, no gamma, not multiplied by alpha. Floats become half by rounding to nearest.
void write_texture(const std::filesystem::path& path, const TextureLayout& layout, const FillRows& fill);

/// Bytes that write_texture takes for that many channels, without what `fill` uses.
std::uint64_t texture_writing_bytes(int width, std::uint64_t channels, bool tiff);

/// SHA-256 of a file's bytes, in hexadecimal. Throws Error.
std::string sha256_of_file(const InputFile& file);
/// SHA-256 of these bytes, in hexadecimal.
std::string sha256_of(std::string_view bytes);

}  // namespace heightlight
