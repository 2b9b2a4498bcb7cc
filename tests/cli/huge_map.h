#pragma once

#include <filesystem>
#include <fstream>

#include "files/image_file.h"
#include "heightlight/image.h"

namespace heightlight {

/// A PNG whose header tells of 30000 × 30000 samples, of which there is nothing: whoever decoded it would say
/// so.
inline void write_huge_map(const std::filesystem::path& path) {
  write_png16(path, Image<std::uint16_t>(16, 16, 7));
  constexpr std::streamoff kSizeInHeader = 16;
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  file.seekp(kSizeInHeader);
  file.write("\0\0\x75\x30\0\0\x75\x30", 8);
}

}  // namespace heightlight
