// Pictures of every format, through the loader of heightmaps.

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cmath>
#include <cstring>

#include "fuzz_input.h"
#include "heightlight/files.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 |
         bytes[3];
}

/// Past its checksums, a PNG gets to where mistakes are.
void mend_png_checksums(std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kSignature = 8;
  if (size < kSignature || std::memcmp(data, "\x89PNG", 4) != 0) return;
  for (std::size_t at = kSignature; size - at >= 12;) {
    const std::size_t length = big_endian(data + at);
    if (length > size - at - 12) return;
    boost::crc_32_type checksum;
    checksum.process_bytes(data + at + 4, length + 4);
    for (int i = 0; i < 4; ++i)
      data[at + 8 + length + static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(checksum.checksum() >> (24 - 8 * i));
    at += length + 12;
  }
}

void check_map(const heightlight::Heightmap& map) {
  using heightlight::require;
  require(map.height.size() ==
              static_cast<std::size_t>(map.height.width) * static_cast<std::size_t>(map.height.height),
          "a map has its samples");
  require(map.spacing.x > 0 && map.spacing.y > 0, "spacing is positive");
  std::size_t present = 0;
  for (const float height : map.height.values) {
    require(std::isnan(height) || (height >= 0 && std::isfinite(height)), "heights are finite, from 0 up");
    present += std::isnan(height) ? 0 : 1;
  }
  require(present > 0, "some sample is present");
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  OIIO::attribute("threads", 1);
  OIIO::attribute("exr_threads", -1);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int) {
  size = LLVMFuzzerMutate(data, size, max_size);
  mend_png_checksums(data, size);
  return size;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace heightlight;
  static MemoryFile file;
  const auto& path = file.hold(data, size);
  expect_line_or_result(path, [&] { check_map(load_heightmap(path, {}, kReaderMemory).map); });
  return 0;
}
