#include "files/tiff_facts.h"

#include <tiffio.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "files/interrupt.h"

namespace heightlight {
namespace {

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, CloseTiff>;

/// libtiff's own words are for its developers. What it could not read, the reader of samples says.
int say_nothing(TIFF*, void*, const char*, const char*, va_list) { return 1; }

Tiff open_tiff(const InputFile& file) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), say_nothing, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  // No mapping: a file that is cut short while it is mapped ends the process.
  Tiff tiff(TIFFOpenExt(file.name_for_libraries().c_str(), "rm", options.get()));
  if (!tiff) throw file.error("cannot be read as tiff: its directory is damaged or truncated");
  return tiff;
}

std::optional<std::string> read_text(TIFF* tiff, std::uint32_t tag) {
  std::uint32_t count = 0;
  const char* text = nullptr;
  if (!TIFFGetField(tiff, tag, &count, &text) || !text) return std::nullopt;
  const std::string all(text, count);
  return all.substr(0, all.find('\0'));
}

/// Values of a tag that libtiff does not know by name.
template <class T>
std::vector<T> read_values(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, type);
  std::uint32_t count = 0;
  const T* values = nullptr;
  if (!field || TIFFFieldDataType(field) != type || !TIFFGetField(tiff, tag, &count, &values) || !values)
    return {};
  return {values, values + count};
}

/// OGC GeoTIFF 1.1: tags 33550 (scale), 33922 (tie points: column, row, 0, x, y, 0), 34735 (keys: four
/// shorts of header, then four for each key: number, place, count, value).
void add_place_on_earth(TIFF* tiff, TiffFacts& facts) {
  const std::vector<double> scale = read_values<double>(tiff, 33550, TIFF_DOUBLE);
  if (scale.size() < 2 || !(scale[0] > 0) || !(scale[1] > 0)) return;
  facts.pixel_scale = {scale[0], scale[1]};
  const std::vector<double> tie = read_values<double>(tiff, 33922, TIFF_DOUBLE);
  if (tie.size() >= 6) {
    facts.west = tie[3] - tie[0] * scale[0];
    facts.north = tie[4] + tie[1] * scale[1];
  }
  constexpr std::uint16_t kModelType = 1024;
  constexpr std::uint16_t kGeographic = 2;
  const std::vector<std::uint16_t> keys = read_values<std::uint16_t>(tiff, 34735, TIFF_SHORT);
  for (std::size_t at = 4; at + 4 <= keys.size(); at += 4) {
    if (keys[at] == kModelType) facts.in_degrees = keys[at + 3] == kGeographic;
  }
}

/// Whether a zlib stream is whole, down to its Adler-32.
bool is_whole_stream(const std::vector<unsigned char>& stream) {
  z_stream state{};
  if (inflateInit(&state) != Z_OK) throw std::bad_alloc();
  state.next_in = const_cast<unsigned char*>(stream.data());
  state.avail_in = static_cast<uInt>(stream.size());
  std::vector<unsigned char> dropped(1 << 16);
  int result = Z_OK;
  while (result == Z_OK) {
    state.next_out = dropped.data();
    state.avail_out = static_cast<uInt>(dropped.size());
    result = inflate(&state, Z_NO_FLUSH);
  }
  inflateEnd(&state);
  return result == Z_STREAM_END;
}

}  // namespace

TiffFacts read_tiff_facts(const InputFile& file) {
  const Tiff tiff = open_tiff(file);
  TiffFacts facts;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_PHOTOMETRIC, &photometric);
  facts.white_is_zero = photometric == PHOTOMETRIC_MINISWHITE;
  facts.is_cmyk_in_tiles = photometric == PHOTOMETRIC_SEPARATED && TIFFIsTiled(tiff.get());
  constexpr std::uint32_t kNoData = 42113;
  facts.no_data = read_text(tiff.get(), kNoData);
  add_place_on_earth(tiff.get(), facts);
  return facts;
}

void check_tiff_sums(const InputFile& file) {
  const Tiff tiff = open_tiff(file);
  std::uint16_t compression = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_COMPRESSION, &compression);
  if (compression != COMPRESSION_ADOBE_DEFLATE && compression != COMPRESSION_DEFLATE) return;
  const bool tiled = TIFFIsTiled(tiff.get()) != 0;
  const std::uint32_t blocks = tiled ? TIFFNumberOfTiles(tiff.get()) : TIFFNumberOfStrips(tiff.get());
  std::vector<unsigned char> stream;
  for (std::uint32_t block = 0; block < blocks; ++block) {
    throw_if_interrupted();
    const std::uint64_t bytes = TIFFGetStrileByteCount(tiff.get(), block);
    if (bytes == 0) continue;          // a block that was left out: all zeros
    if (bytes > UINT32_MAX) continue;  // more than zlib takes at once, or OpenImageIO
    if (bytes > file.size()) throw file.error("is damaged or truncated: a block ends beyond the file");
    stream.resize(bytes);
    const auto count = static_cast<tmsize_t>(bytes);
    const tmsize_t got = tiled ? TIFFReadRawTile(tiff.get(), block, stream.data(), count)
                               : TIFFReadRawStrip(tiff.get(), block, stream.data(), count);
    if (got != count || !is_whole_stream(stream))
      throw file.error("is damaged: a block's checksum is wrong, or its compressed data is");
  }
}

}  // namespace heightlight
