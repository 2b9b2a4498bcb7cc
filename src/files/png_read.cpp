// stb's decoder, for this file alone: no other program that we are linked into sees its names.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_FAILURE_USERMSG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <array>
#include <boost/crc.hpp>
#include <memory>

#include "files/image_read.h"
#include "files/input_file.h"
#include "files/map_size.h"

namespace heightlight {
namespace {

struct FreeStb {
  void operator()(void* pixels) const { stbi_image_free(pixels); }
};

/// The image header chunk, which comes first.
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

PngHeader read_header(const std::filesystem::path& path, std::FILE* file) {
  std::array<unsigned char, 26> bytes{};
  if (std::fread(bytes.data(), 1, bytes.size(), file) != bytes.size()) throw file_error(path, "is truncated");
  std::rewind(file);
  return {big_endian(&bytes[16]), big_endian(&bytes[20]), bytes[24], bytes[25]};
}

/// Walks the chunks up to IEND and compares their checksums, which stb leaves out: a damaged file would come
/// through it as a surface with wrong heights. Leaves the file at its beginning.
void check_chunks(const std::filesystem::path& path, std::FILE* file) {
  constexpr std::size_t kSignatureSize = 8;
  std::vector<unsigned char> block(1 << 16);
  const auto take = [&](std::size_t count) {
    if (std::fread(block.data(), 1, count, file) != count) throw file_error(path, "is truncated");
  };
  take(kSignatureSize);
  for (bool ended = false; !ended;) {
    take(8);  // length and type
    std::size_t left = big_endian(block.data());
    ended = std::equal(&block[4], &block[8], "IEND");
    boost::crc_32_type checksum;
    checksum.process_bytes(&block[4], 4);
    while (left > 0) {
      const std::size_t count = std::min(left, block.size());
      take(count);
      checksum.process_bytes(block.data(), count);
      left -= count;
    }
    take(4);
    if (big_endian(block.data()) != checksum.checksum())
      throw file_error(path, "is damaged: a PNG checksum is wrong");
  }
  std::rewind(file);
}

/// Channels that stb can give at most; only a transparent palette makes four of one.
std::uint64_t most_channels(int colour_type) { return colour_type == 0 ? 2 : 4; }

template <class T>
std::vector<T> copy_samples(const void* pixels, std::size_t count) {
  const T* first = static_cast<const T*>(pixels);
  return std::vector<T>(first, first + count);
}

}  // namespace

StoredImage read_png(const std::filesystem::path& path, std::uint64_t memory_limit) {
  const File file = open_input(path);
  const PngHeader header = read_header(path, file.get());
  const bool wide = header.bits == 16;
  // stb holds the compressed, the filtered and the final bytes together.
  constexpr std::uint64_t kCopies = 3;
  check_map_size(path, header.width, header.height,
                 bytes_per_texel(kCopies * most_channels(header.colour_type) * (wide ? 2 : 1)), memory_limit);
  check_chunks(path, file.get());

  StoredImage image;
  int count = 0;
  const std::unique_ptr<void, FreeStb> pixels(
      wide ? static_cast<void*>(stbi_load_from_file_16(file.get(), &image.width, &image.height, &count, 0))
           : static_cast<void*>(stbi_load_from_file(file.get(), &image.width, &image.height, &count, 0)));
  if (!pixels) {
    const char* reason = stbi_failure_reason();
    throw file_error(path, std::string("cannot be decoded as PNG: ") + (reason ? reason : "damaged"));
  }

  constexpr std::array kNames{"Y", "YA", "RGB", "RGBA"};
  for (const char* name = kNames[static_cast<std::size_t>(count - 1)]; *name; ++name)
    image.channels.emplace_back(1, *name);
  image.sample_type = wide ? "uint16" : "uint8";
  image.bits = header.bits;
  image.is_integer = true;
  const std::size_t samples =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * image.channels.size();
  if (wide) {
    image.samples = copy_samples<std::uint16_t>(pixels.get(), samples);
  } else {
    image.samples = copy_samples<std::uint8_t>(pixels.get(), samples);
  }
  return image;
}

}  // namespace heightlight
