#include <png.h>

#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <set>

#include "files/image_read.h"
#include "files/input_file.h"
#include "files/map_size.h"

namespace heightlight {
namespace {

/// State of a libpng reader. libpng reports errors with longjmp, which must not skip destructors; hence all
/// objects that are alive during reading are members of this struct or of the image.
struct PngState {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string fault;
  /// types of the optional chunks with a wrong checksum, which libpng skipped
  std::set<std::string> bad_sums;
  std::vector<png_bytep> rows;

  PngState() = default;
  ~PngState() { png_destroy_read_struct(&png, &info, nullptr); }
  PngState(const PngState&) = delete;
  PngState& operator=(const PngState&) = delete;
};

PngState& state_of(png_structp png) { return *static_cast<PngState*>(png_get_error_ptr(png)); }

[[noreturn]] void note_error(png_structp png, png_const_charp message) {
  state_of(png).fault = message;
  png_longjmp(png, 1);
}

/// Handles a warning about a chunk that libpng skips. Only tRNS affects the samples: it says which are
/// transparent.
void note_warning(png_structp png, png_const_charp message) {
  if (std::strncmp(message, "tRNS", 4) == 0) note_error(png, message);
  if (std::strstr(message, "CRC error")) state_of(png).bad_sums.emplace(message, 4);
}

/// The image header chunk, which comes first in a PNG.
struct PngHeader {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bits = 0;
  int colour_type = 0;
};

std::uint32_t big_endian(const unsigned char* bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24 | static_cast<std::uint32_t>(bytes[1]) << 16 |
         static_cast<std::uint32_t>(bytes[2]) << 8 | static_cast<std::uint32_t>(bytes[3]);
}

PngHeader read_first_chunk(const InputFile& file) {
  std::array<unsigned char, 26> bytes{};
  if (std::fread(bytes.data(), 1, bytes.size(), file.rewound()) != bytes.size())
    throw file.error("is truncated");
  const std::string chunk(&bytes[12], &bytes[16]);
  if (chunk == "CgBI") {
    throw file.error(
        "is a PNG in Apple's own variant (CgBI), which other programs do not read; export it again as PNG");
  }
  if (chunk != "IHDR") throw file.error("is damaged: a PNG begins with its header chunk, IHDR");
  return {big_endian(&bytes[16]), big_endian(&bytes[20]), bytes[24], bytes[25]};
}

/// The largest number of channels for a colour type; a palette with transparency expands to four.
std::uint64_t most_channels(int colour_type) { return colour_type == PNG_COLOR_TYPE_GRAY ? 2 : 4; }

/// Reads up to the first sample, and sets transformations that give 8 or 16 bits per channel for every kind
/// of PNG.
bool read_header(PngState& state, std::FILE* stream) {
  if (setjmp(png_jmpbuf(state.png))) return false;
  png_init_io(state.png, stream);
  png_read_info(state.png, state.info);
  png_set_palette_to_rgb(state.png);
  png_set_expand_gray_1_2_4_to_8(state.png);
  if (png_get_valid(state.png, state.info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(state.png);
  if (std::endian::native == std::endian::little) png_set_swap(state.png);
  png_set_interlace_handling(state.png);
  png_read_update_info(state.png, state.info);
  return true;
}

bool read_rows(PngState& state) {
  if (setjmp(png_jmpbuf(state.png))) return false;
  png_read_image(state.png, state.rows.data());
  png_read_end(state.png, nullptr);
  return true;
}

Error decoding_error(const InputFile& file, const std::string& fault) {
  if (fault.find("CRC error") != std::string::npos)
    return file.error("is damaged: a PNG checksum is wrong (" + fault.substr(0, 4) + ")");
  if (fault == "Read Error") return file.error("is truncated");
  return file.error("is damaged, and cannot be decoded as PNG: " + fault);
}

template <class T>
StoredSamples make_rows(PngState& state, std::size_t rows, std::size_t samples_per_row) {
  std::vector<T> samples(rows * samples_per_row);
  for (std::size_t row = 0; row < rows; ++row) {
    state.rows.push_back(reinterpret_cast<png_bytep>(samples.data() + row * samples_per_row));
  }
  return samples;
}

}  // namespace

StoredImage read_png(const InputFile& file, const ReadLimit& limit) {
  const PngHeader header = read_first_chunk(file);
  const std::size_t sample_bytes = header.bits == 16 ? 2 : 1;
  check_map_size(file.path(), header.width, header.height,
                 bytes_per_texel(most_channels(header.colour_type) * sample_bytes), limit);
  PngState state;
  state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, note_error, note_warning);
  if (state.png) state.info = png_create_info_struct(state.png);
  if (!state.info) throw std::bad_alloc();
  if (!read_header(state, file.rewound())) throw decoding_error(file, state.fault);

  StoredImage image;
  image.width = static_cast<int>(header.width);
  image.height = static_cast<int>(header.height);
  const std::size_t channels = png_get_channels(state.png, state.info);
  constexpr std::array kChannelNames{"Y", "YA", "RGB", "RGBA"};
  for (const char* name = kChannelNames.at(channels - 1); *name; ++name)
    image.channels.emplace_back(1, *name);
  image.sample_type = sample_bytes == 2 ? "uint16" : "uint8";
  image.bits = header.bits;
  image.is_integer = true;
  image.samples = sample_bytes == 2 ? make_rows<std::uint16_t>(state, header.height, header.width * channels)
                                    : make_rows<std::uint8_t>(state, header.height, header.width * channels);
  const bool as_announced = png_get_image_width(state.png, state.info) == header.width &&
                            png_get_image_height(state.png, state.info) == header.height &&
                            png_get_rowbytes(state.png, state.info) == header.width * channels * sample_bytes;
  if (!as_announced) throw file.error("was written to while it was read");
  if (!read_rows(state)) throw decoding_error(file, state.fault);
  for (const std::string& chunk : state.bad_sums) {
    image.warnings.push_back("the checksum of a chunk " + chunk +
                             " is wrong; such chunks say nothing of the samples, and it was left out");
  }
  return image;
}

}  // namespace heightlight
