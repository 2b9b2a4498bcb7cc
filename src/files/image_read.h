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

/// Samples in the type in which the file stores them, save half, which becomes float without loss.
using StoredSamples =
    std::variant<std::vector<std::uint8_t>, std::vector<std::int8_t>, std::vector<std::uint16_t>,
                 std::vector<std::int16_t>, std::vector<std::uint32_t>, std::vector<std::int32_t>,
                 std::vector<float>, std::vector<double>>;

/// An image as its file holds it: no colour conversion, no scaling, alpha not multiplied in.
struct StoredImage {
  int width = 0;
  int height = 0;
  std::string sample_type;  ///< "uint8", "uint16", "half", "float", …
  int bits = 0;             ///< per sample, in the file
  bool is_integer = false;
  std::vector<std::string> channels;  ///< in the file's order; alpha is "A"
  std::optional<TiffFacts> tiff;      ///< of a TIFF
  std::vector<std::string> warnings;  ///< of what could be read all the same
  StoredSamples samples;              ///< row-major, row 0 on top, channels interleaved
};

/// Reads an image, whose format is not esri_grid: the first of a TIFF, the only part of an EXR or the one
/// that `part` names (any case) or counts (from 0). The header's size is checked (check_map_size) before
/// samples are read; `limit` in bytes must hold the samples and what heights are made of. Throws Error
/// naming the file when it is truncated or damaged, too large, deep, of an unknown sample type, or an EXR of
/// several parts without `part`, UsageError for a `part` that it does not have.
StoredImage read_image(const InputFile& file, FileFormat format, const ReadLimit& limit,
                       const std::optional<std::string>& part = {});

/// The rows of a TIFF, for images that memory need not hold as a whole.
class TiffRows {
 public:
  /// Reads the header, and looks at every block (check_tiff_blocks). `file` must outlive it. Throws as
  /// read_image does.
  explicit TiffRows(const InputFile& file);
  ~TiffRows();
  TiffRows(const TiffRows&) = delete;
  TiffRows& operator=(const TiffRows&) = delete;

  /// The image, without samples.
  const StoredImage& header() const { return header_; }

  /// Rows that one look at the file gives: reading should begin at multiples of these.
  int together() const;

  /// Rows [first, first + count), as an image of their own. Where the file has tiles, `first` is a multiple
  /// of together(), and so is `count`, but at the end. Throws Error naming a damaged file.
  StoredImage read(int first, int count);

 private:
  struct Library;

  const InputFile& file_;
  StoredImage header_;
  std::unique_ptr<Library> library_;
};

/// Part of read_image: PNG, through libpng.
StoredImage read_png(const InputFile& file, const ReadLimit& limit);

/// Bytes for each texel while a heightmap is made: the file's samples beside one channel of them as double
/// and a mark of what is transparent, and afterwards those doubles beside the heights as float.
constexpr std::uint64_t bytes_per_texel(std::uint64_t stored_bytes) {
  constexpr std::uint64_t kHeight = sizeof(float);
  const std::uint64_t marked = stored_bytes + 1;
  return sizeof(double) + (marked > kHeight ? marked : kHeight);
}

/// Channels of an image, from its header: of the first part of several. Throws Error likewise.
int count_channels(const InputFile& file, FileFormat format);

}  // namespace heightlight
