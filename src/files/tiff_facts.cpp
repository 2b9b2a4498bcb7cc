#include "files/tiff_facts.h"

#include <tiffio.h>
#include <zlib.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <memory>
#include <new>
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

/// Values of a tag that libtiff does not know by name, and hands out with a count of 32 bits. Nothing where a
/// program around this one has taught it otherwise.
template <class T>
std::vector<T> read_values(TIFF* tiff, std::uint32_t tag, TIFFDataType type) {
  const TIFFField* field = TIFFFindField(tiff, tag, type);
  if (!field || TIFFFieldDataType(field) != type || !TIFFFieldPassCount(field) ||
      TIFFFieldReadCount(field) != TIFF_VARIABLE2)
    return {};
  std::uint32_t count = 0;
  const T* values = nullptr;
  if (!TIFFGetField(tiff, tag, &count, &values) || !values) return {};
  return {values, values + count};
}

std::optional<std::string> read_text(TIFF* tiff, std::uint32_t tag) {
  const std::vector<char> text = read_values<char>(tiff, tag, TIFF_ASCII);
  if (text.empty()) return std::nullopt;
  return std::string(text.begin(), std::find(text.begin(), text.end(), '\0'));
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

/// A zlib stream, inflated as its pieces come and dropped.
class DroppedStream {
 public:
  DroppedStream() {
    if (inflateInit(&state_) != Z_OK) throw std::bad_alloc();
  }
  ~DroppedStream() { inflateEnd(&state_); }
  DroppedStream(const DroppedStream&) = delete;
  DroppedStream& operator=(const DroppedStream&) = delete;

  void take(std::vector<unsigned char>& piece, std::size_t count) {
    state_.next_in = piece.data();
    state_.avail_in = static_cast<uInt>(count);
    while (result_ == Z_OK && state_.avail_in > 0) {
      state_.next_out = dropped_.data();
      state_.avail_out = static_cast<uInt>(dropped_.size());
      result_ = inflate(&state_, Z_NO_FLUSH);
    }
  }

  /// Down to its Adler-32.
  bool is_whole() {
    while (result_ == Z_OK) {
      state_.next_out = dropped_.data();
      state_.avail_out = static_cast<uInt>(dropped_.size());
      result_ = inflate(&state_, Z_NO_FLUSH);
    }
    return result_ == Z_STREAM_END;
  }

 private:
  z_stream state_{};
  std::vector<unsigned char> dropped_ = std::vector<unsigned char>(1 << 16);
  int result_ = Z_OK;
};

bool is_whole_stream(const InputFile& file, std::uint64_t begin, std::uint64_t bytes) {
  DroppedStream stream;
  std::vector<unsigned char> piece(1 << 16);
  std::FILE* const source = file.rewound();
  if (fseeko(source, static_cast<off_t>(begin), SEEK_SET) != 0) return false;
  while (bytes > 0) {
    const std::size_t wanted = std::min<std::uint64_t>(bytes, piece.size());
    const std::size_t got = std::fread(piece.data(), 1, wanted, source);
    if (got == 0) return false;
    stream.take(piece, got);
    bytes -= got;
  }
  return stream.is_whole();
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

void check_tiff_blocks(const InputFile& file) {
  const Tiff tiff = open_tiff(file);
  std::uint16_t compression = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_COMPRESSION, &compression);
  const bool deflated = compression == COMPRESSION_ADOBE_DEFLATE || compression == COMPRESSION_DEFLATE;
  const bool tiled = TIFFIsTiled(tiff.get()) != 0;
  const std::uint32_t blocks = tiled ? TIFFNumberOfTiles(tiff.get()) : TIFFNumberOfStrips(tiff.get());
  const auto whole = static_cast<std::uint64_t>(tiled ? TIFFTileSize(tiff.get()) : TIFFStripSize(tiff.get()));
  constexpr std::uint64_t kBlockSlack =
      1 << 16;  // no compression makes more than twice as much of what it gets
  for (std::uint32_t block = 0; block < blocks; ++block) {
    throw_if_interrupted();
    const std::uint64_t begin = TIFFGetStrileOffset(tiff.get(), block);
    const std::uint64_t bytes = TIFFGetStrileByteCount(tiff.get(), block);
    if (bytes == 0) continue;  // a block that was left out: all zeros
    if (begin > file.size() || bytes > file.size() - begin)
      throw file.error("is damaged or truncated: a block ends beyond the file");
    if (bytes > 2 * whole + kBlockSlack) throw file.error("is damaged: a block is larger than what it holds");
    if (deflated && !is_whole_stream(file, begin, bytes))
      throw file.error("is damaged: a block's checksum is wrong, or its compressed data is");
  }
}

}  // namespace heightlight
