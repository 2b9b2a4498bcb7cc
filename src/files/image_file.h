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

/// Each writer replaces `path`, and throws Error naming it and what is wrong (full disk, unwritable folder).

/// 8-bit sRGB picture, through stb.
void write_png(const std::filesystem::path& path, const Image<Rgb8>& picture);

/// 16-bit grey, levels as given.
void write_png16(const std::filesystem::path& path, const Image<std::uint16_t>& levels);

/// float32 EXR with one map per named channel ("Y", or "R", "G", "B"), all of one
/// size. `attributes` are text attributes of the header. NaN is kept.
void write_float_image(const std::filesystem::path& path,
                       const std::vector<std::pair<std::string, const Map*>>& channels,
                       const std::vector<std::pair<std::string, std::string>>& attributes = {});

/// How samples are stored.
enum class SampleType { uint8, uint16, half, real };

/// What a band of a GeoTIFF says of itself.
struct BandText {
  std::string description = {};
  std::string unit = {};
};

/// What a texture file is to hold.
struct TextureLayout {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels = {};  ///< "Y", or "R", "G", …; channels named "A" are no coverage
  SampleType type = SampleType::uint16;
  std::vector<std::pair<std::string, std::string>> attributes = {};  ///< text, where the format has it
  const Georeference* place = nullptr;                               ///< of a TIFF: where on earth it lies
  std::vector<BandText> bands = {};  ///< of a TIFF with a place: of each channel, or none
};

/// Fills rows [first, first + count) with samples, channels interleaved: whole levels for integers.
using FillRows = std::function<void(int first, int count, float* samples)>;

/// PNG, EXR or TIFF by extension, some rows at a time. Values are stored as they are: linear, no gamma, alpha
/// not multiplied in. Floats become half by rounding to the nearest.
void write_texture(const std::filesystem::path& path, const TextureLayout& layout, const FillRows& fill);

/// Bytes that write_texture takes for so many channels, beside what fills the rows.
std::uint64_t texture_writing_bytes(int width, std::uint64_t channels, bool tiff);

/// SHA-256 of a file's bytes, hexadecimal. Throws Error.
std::string sha256_of_file(const InputFile& file);
/// Of these bytes.
std::string sha256_of(std::string_view bytes);

}  // namespace heightlight
