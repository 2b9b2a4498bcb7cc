#include "files/tiff_write.h"

#include <OpenImageIO/imageio.h>
#include <tiffio.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstring>
#include <memory>

#include "files/interrupt.h"
#include "files/missing_mark.h"
#include "files/output_file.h"
#include "files/tiff_tags.h"

namespace heightlight {
namespace {

// The file operations that libtiff needs, implemented on a stream.
std::FILE* stream_of(thandle_t handle) { return static_cast<std::FILE*>(handle); }

tmsize_t read_stream(thandle_t handle, void* bytes, tmsize_t count) {
  return static_cast<tmsize_t>(std::fread(bytes, 1, static_cast<std::size_t>(count), stream_of(handle)));
}

tmsize_t write_stream(thandle_t handle, void* bytes, tmsize_t count) {
  return static_cast<tmsize_t>(std::fwrite(bytes, 1, static_cast<std::size_t>(count), stream_of(handle)));
}

toff_t seek_stream(thandle_t handle, toff_t offset, int whence) {
  if (fseeko(stream_of(handle), static_cast<off_t>(offset), whence) != 0) return static_cast<toff_t>(-1);
  return static_cast<toff_t>(ftello(stream_of(handle)));
}

int leave_stream(thandle_t) { return 0; }

toff_t size_of_stream(thandle_t handle) {
  const off_t here = ftello(stream_of(handle));
  const toff_t size = seek_stream(handle, 0, SEEK_END);
  fseeko(stream_of(handle), here, SEEK_SET);
  return size;
}

int keep_first_fault(TIFF*, void* user, const char*, const char* format, va_list arguments) {
  auto& fault = *static_cast<std::string*>(user);
  if (!fault.empty()) return 1;
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  fault = text;
  return 1;
}

struct EndTiff {
  void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using TiffOutput = std::unique_ptr<TIFF, EndTiff>;

TiffOutput open_tiff_output(std::FILE* stream, const std::filesystem::path& path, bool big,
                            std::string& fault) {
  const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(),
                                                                                 TIFFOpenOptionsFree);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keep_first_fault, &fault);
  TiffOutput tiff(TIFFClientOpenExt(path.c_str(), big ? "w8l" : "wl", stream, read_stream, write_stream,
                                    seek_stream, leave_stream, size_of_stream, nullptr, nullptr,
                                    options.get()));
  return tiff;
}

void store(SampleType type, const float* samples, std::size_t count, unsigned char* bytes) {
  const auto as = [&](auto sample_of) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto sample = sample_of(samples[i]);
      std::memcpy(bytes + i * sizeof sample, &sample, sizeof sample);
    }
  };
  switch (type) {
    case SampleType::uint8:
      return as([](float value) { return static_cast<std::uint8_t>(value); });
    case SampleType::uint16:
      return as([](float value) { return static_cast<std::uint16_t>(value); });
    case SampleType::half:
      OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, samples, OIIO::TypeDesc::HALF, bytes,
                                 static_cast<int>(count));
      return;
    case SampleType::real:
      return as([](float value) { return value; });
  }
}

std::size_t bytes_of_sample(SampleType type) {
  return type == SampleType::uint8 ? 1 : type == SampleType::real ? 4 : 2;
}

/// Whether 32-bit offsets may not suffice: assumes uncompressed samples, with overviews.
bool is_big(const TextureLayout& layout) {
  const double samples =
      double{1} * layout.width * layout.height * static_cast<double>(layout.channels.size());
  constexpr double kLargest = 4.0e9;
  return samples * 4 / 3 * static_cast<double>(bytes_of_sample(layout.type)) > kLargest;
}

/// Rows of an overview: means of the present samples among factor × factor; rounded to whole levels for
/// integers.
class ReducedRows {
 public:
  ReducedRows(const TextureLayout& layout, const FillRows& fill, int factor)
      : layout_(layout), fill_(fill), factor_(factor), width_((layout.width + factor - 1) / factor) {
    const std::size_t line = static_cast<std::size_t>(layout.width) * layout.channels.size();
    full_.resize(factor > 1 ? line * static_cast<std::size_t>(factor) : 0);
  }

  int width() const { return width_; }
  int height() const { return (layout_.height + factor_ - 1) / factor_; }

  /// Rows [first, first + count) of the overview.
  void fill(int first, int count, float* samples) {
    if (factor_ == 1) return fill_(first, count, samples);
    const std::size_t line = static_cast<std::size_t>(width_) * layout_.channels.size();
    for (int i = 0; i < count; ++i) reduce(first + i, samples + static_cast<std::size_t>(i) * line);
  }

 private:
  void reduce(int row, float* samples) {
    const int top = row * factor_;
    const int rows = std::min(factor_, layout_.height - top);
    fill_(top, rows, full_.data());
    const auto channels = static_cast<int>(layout_.channels.size());
    for (int column = 0; column < width_; ++column) {
      for (int c = 0; c < channels; ++c) *samples++ = mean(rows, column, c);
    }
  }

  float mean(int rows, int column, int channel) const {
    const auto channels = static_cast<int>(layout_.channels.size());
    const int last = std::min((column + 1) * factor_, layout_.width);
    double sum = 0;
    int present = 0;
    for (int i = 0; i < rows; ++i) {
      for (int j = column * factor_; j < last; ++j) {
        const float value = full_[(static_cast<std::size_t>(i) * static_cast<std::size_t>(layout_.width) +
                                   static_cast<std::size_t>(j)) *
                                      static_cast<std::size_t>(channels) +
                                  static_cast<std::size_t>(channel)];
        if (std::isnan(value)) continue;
        sum += double{value};
        ++present;
      }
    }
    if (present == 0) return std::nanf("");
    const bool is_level = layout_.type == SampleType::uint8 || layout_.type == SampleType::uint16;
    return static_cast<float>(is_level ? std::floor(sum / present + 0.5) : sum / present);
  }

  const TextureLayout& layout_;
  const FillRows& fill_;
  int factor_;
  int width_;
  std::vector<float> full_;
};

/// Writes one image of the file, tile by tile; tiles are filled with zeros beyond the map. False if libtiff
/// fails.
bool write_tiles(TIFF* tiff, const TextureLayout& layout, ReducedRows& rows) {
  const std::size_t channels = layout.channels.size();
  const auto width = static_cast<std::size_t>(rows.width());
  const std::optional<MissingMark> mark =
      layout.type == SampleType::real ? missing_mark_of(layout) : std::nullopt;
  const std::size_t pixel = channels * bytes_of_sample(layout.type);
  std::vector<float> band;
  std::vector<unsigned char> tile(kTiffTile * kTiffTile * pixel);
  for (int top = 0; top < rows.height(); top += kTiffTile) {
    throw_if_interrupted();
    const int count = std::min(kTiffTile, rows.height() - top);
    band.resize(static_cast<std::size_t>(count) * width * channels);
    rows.fill(top, count, band.data());
    for (float& sample : band) {
      if (mark) sample = mark_missing(*mark, sample);
    }
    for (std::size_t left = 0; left < width; left += kTiffTile) {
      const std::size_t columns = std::min<std::size_t>(kTiffTile, width - left);
      std::fill(tile.begin(), tile.end(), static_cast<unsigned char>(0));
      for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        store(layout.type, band.data() + (i * width + left) * channels, columns * channels,
              tile.data() + i * kTiffTile * pixel);
      }
      const auto column = static_cast<std::uint32_t>(left);
      if (TIFFWriteTile(tiff, tile.data(), column, static_cast<std::uint32_t>(top), 0, 0) < 0) return false;
    }
  }
  return TIFFWriteDirectory(tiff) != 0;
}

/// The factor 1, and 2, 4 … for the overviews of a georeferenced map.
std::vector<int> factors_of(const TextureLayout& layout) {
  std::vector<int> factors{1};
  const int side = std::max(layout.width, layout.height);
  for (int factor = 2; layout.place && side > kTiffTile * factor / 2; factor *= 2) factors.push_back(factor);
  return factors;
}

}  // namespace

void write_tiff(const std::filesystem::path& path, const TextureLayout& layout, const FillRows& fill) {
  write_file(path, [&](std::FILE* stream) {
    std::string fault;
    bool written = true;
    {
      const TiffOutput tiff = open_tiff_output(stream, path, is_big(layout), fault);
      if (!tiff) throw output_error(path, fault);
      know_place_tags(tiff.get());
      for (const int factor : factors_of(layout)) {
        if (factor > 1) TIFFCreateDirectory(tiff.get());
        know_place_tags(tiff.get());
        set_tiff_tags(tiff.get(), layout, factor);
        ReducedRows rows(layout, fill, factor);
        written = written && write_tiles(tiff.get(), layout, rows);
      }
    }
    // The error of a failed stream (no space left) is clearer than the library's message.
    if (!std::ferror(stream) && (!written || !fault.empty())) throw output_error(path, fault);
  });
}

}  // namespace heightlight
