#include "files/tiff_facts.h"

#include <tiffio.h>
#include <zlib.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

#include "files/geo_keys.h"
#include "files/interrupt.h"
#include "files/no_data.h"

namespace heightlight {
namespace {

struct CloseTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using Tiff = std::unique_ptr<TIFF, CloseTiff>;

/// Suppresses libtiff's messages, which are meant for developers. The reader of samples reports what could
/// not be read.
int say_nothing(TIFF*, void*, const char*, const char*, va_list) { return 1; }

Tiff open_tiff(const InputFile& file) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), say_nothing, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), say_nothing, nullptr);
  // Without memory mapping: a file that is truncated while it is mapped crashes the process.
  Tiff tiff(TIFFOpenExt(file.name_for_libraries().c_str(), "rm", options.get()));
  if (!tiff) throw file.error("cannot be read as tiff: its directory is damaged or truncated");
  return tiff;
}

/// The tags that describe the georeference, in rising order.
constexpr std::uint16_t kPlaceTags[] = {kPixelScaleTag,   kTiePointTag,         kTransformationTag,
                                        kKeyDirectoryTag, kDoubleParametersTag, kTextParametersTag,
                                        kGdalMetadataTag, kGdalNoDataTag};

std::size_t bytes_of_type(TIFFDataType type) {
  return type == TIFF_DOUBLE ? sizeof(double) : type == TIFF_SHORT ? sizeof(std::uint16_t) : 1;
}

/// Reads a tag that libtiff does not know by name, for which it returns a count of 32 bits. A host program
/// may have registered the tag otherwise, as GDAL does: with a count of 16 bits, or for texts without a
/// count. Empty if the tag is absent; a tag without bytes if its type is one that no georeference tag has.
std::optional<GeoTag> read_tag(TIFF* tiff, std::uint16_t number) {
  const TIFFField* field = TIFFFindField(tiff, number, TIFF_ANY);
  if (!field) return std::nullopt;
  const TIFFDataType type = TIFFFieldDataType(field);
  const char* values = nullptr;
  std::uint32_t count = 0;
  std::uint16_t short_count = 0;
  bool found = false;
  if (!TIFFFieldPassCount(field)) {
    found = type == TIFF_ASCII && TIFFGetField(tiff, number, &values) && values;
    if (found) count = static_cast<std::uint32_t>(std::strlen(values) + 1);
  } else if (TIFFFieldReadCount(field) == TIFF_VARIABLE2) {
    found = TIFFGetField(tiff, number, &count, &values) && values;
  } else if (TIFFFieldReadCount(field) == TIFF_VARIABLE) {
    found = TIFFGetField(tiff, number, &short_count, &values) && values;
    count = short_count;
  }
  if (!found) return std::nullopt;
  GeoTag tag{number, static_cast<std::uint16_t>(type), ""};
  if (type == TIFF_ASCII || type == TIFF_SHORT || type == TIFF_DOUBLE)
    tag.bytes.assign(values, count * bytes_of_type(type));
  return tag;
}

/// Whether one of the directories after the first is a mask; overviews are among these directories.
bool has_mask(TIFF* tiff) {
  constexpr int kMost = 64;
  for (int i = 0; i < kMost && TIFFReadDirectory(tiff) != 0; ++i) {
    std::uint32_t type = 0;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SUBFILETYPE, &type);
    if ((type & FILETYPE_MASK) != 0) return true;
  }
  return false;
}

/// Inflates a zlib stream piece by piece and discards the result.
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

  /// Inflates the rest; true if the stream is complete down to its Adler-32 checksum.
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
  std::vector<GeoTag> tags;
  for (const std::uint16_t number : kPlaceTags) {
    if (std::optional<GeoTag> tag = read_tag(tiff.get(), number)) tags.push_back(std::move(*tag));
  }
  if (const GeoTag* no_data = find_tag(tags, kGdalNoDataTag); no_data && no_data->type == TIFF_ASCII)
    facts.no_data = text_of(*no_data);
  if (const GeoTag* metadata = find_tag(tags, kGdalMetadataTag)) {
    facts.scale = parse_no_data(metadata_in_role(text_of(*metadata), "scale"));
    facts.offset = parse_no_data(metadata_in_role(text_of(*metadata), "offset"));
  }
  std::uint32_t rows = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &rows);
  facts.place = read_geotiff_place(tags, static_cast<int>(rows));
  facts.has_mask = has_mask(tiff.get());
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
  constexpr std::uint64_t kBlockSlack = 1
                                        << 16;  // a compressed block is at most twice as large as its content
  for (std::uint32_t block = 0; block < blocks; ++block) {
    throw_if_interrupted();
    const std::uint64_t begin = TIFFGetStrileOffset(tiff.get(), block);
    const std::uint64_t bytes = TIFFGetStrileByteCount(tiff.get(), block);
    if (bytes == 0) continue;  // an omitted block: all zeros
    if (begin > file.size() || bytes > file.size() - begin)
      throw file.error("is damaged or truncated: a block ends beyond the file");
    if (bytes > 2 * whole + kBlockSlack) throw file.error("is damaged: a block is larger than what it holds");
    if (deflated && !is_whole_stream(file, begin, bytes))
      throw file.error("is damaged: a block's checksum is wrong, or its compressed data is");
  }
}

}  // namespace heightlight
