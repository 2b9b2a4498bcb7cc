#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "files/file_format.h"
#include "files/map_size.h"
#include "files/tiff_facts.h"

namespace heightlight {

/// Samples in the type that the file stores, except that half becomes float without loss.
using StoredSamples =
    std::variant<std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::uint16_t>,
                 std::vector<std::int16_t>, std::vector<std::uint32_t>, std::vector<std::int32_t>,
                 std::vector<float>, std::vector<double>>;

/// An image as its file holds it: no colour conversion, no scaling, not multiplied by alpha.
struct StoredImage {
  int width = 0;
  int height = 0;
  std::string sample_type;  ///< "uint8", "uint16", "half", "float", …
  int bits = 0;             ///< per sample, in the file
  bool is_integer = false;
  std::vector<std::string> channels;  ///< in the file's order; alpha is "A"
  std::optional<TiffFacts> tiff;      ///< of a TIFF only
  std::vector<std::string> warnings;  ///< about faults that did not prevent reading
  StoredSamples samples;              ///< row-major, row 0 on top, channels interleaved
};

/// Reads an image; the format must not be esri_grid. Takes the first image of a TIFF; of an EXR, the only
/// part, or the one that `part` names (any case) or counts (from 0). The size in the header is checked
/// (check_map_size) before samples are read; `limit`, in bytes, must hold the samples and the heights made
/// from them. Throws Error naming the file when it is truncated, damaged, too large, deep, of an unknown
/// sample type, or an EXR of several parts without `part`. Throws UsageError for a `part` that the file does
/// not have.
StoredImage read_image(const InputFile& file, FileFormat format, const ReadLimit& limit,
                       const std::optional<std::string>& part = {});

/// Reads the rows of a TIFF, for images that need not be in memory as a whole.
class TiffRows {
 public:
  /// Reads the header and checks every block (check_tiff_blocks). `file` must outlive this object. Throws as
  /// read_image does.
  explicit TiffRows(const InputFile& file);
  ~TiffRows();
  TiffRows(const TiffRows&) = delete;
  TiffRows& operator=(const TiffRows&) = delete;

  /// The image without its samples.
  const StoredImage& header() const { return header_; }

  /// Number of rows that are read together: those of a tile, or of a strip up to 256. Reading should begin at
  /// multiples of it.
  int together() const;

  /// Reads rows [first, first + count), as an image of their own. If the file has tiles, `first` must be a
  /// multiple of together(), and so must `count`, except at the end. Throws Error naming a damaged file.
  StoredImage read(int first, int count);

 private:
  struct Library;

  const InputFile& file_;
  StoredImage header_;
  std::unique_ptr<Library> library_;
};

/// The part of read_image for PNG, through libpng.
StoredImage read_png(const InputFile& file, const ReadLimit& limit);

/// Bytes per texel while a heightmap is made. First the file's samples are held beside one channel of them as
/// double and a one-byte mark of transparency; afterwards those doubles beside the heights as float.
constexpr std::uint64_t bytes_per_texel(std::uint64_t stored_bytes) {
  constexpr std::uint64_t kHeight = sizeof(float);
  const std::uint64_t marked = stored_bytes + 1;
  return sizeof(double) + (marked > kHeight ? marked : kHeight);
}

/// Number of channels of an image, read from its header; of its first part where it has several. Throws Error
/// as read_image does.
int count_channels(const InputFile& file, FileFormat format);

}  // namespace heightlight
