#include "files/exr_header.h"

#include <cstdint>

namespace heightlight {
namespace {

/// Reads the bytes of an OpenEXR file; its numbers are little-endian.
class ExrBytes {
 public:
  explicit ExrBytes(const InputFile& file) : file_(file), stream_(file.rewound()) {}

  int byte() {
    const int value = std::getc(stream_);
    if (value == EOF) throw file_.error("is truncated within its header");
    return value;
  }

  std::uint32_t number() {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 8) value |= static_cast<std::uint32_t>(byte()) << shift;
    return value;
  }

  /// Reads a text that ends with a zero byte.
  std::string name() {
    constexpr std::size_t kLongest = 255;
    std::string text;
    for (int value = byte(); value != 0; value = byte()) {
      text += static_cast<char>(value);
      if (text.size() > kLongest) throw file_.error("is damaged: its header holds no names of attributes");
    }
    return text;
  }

  void skip(std::uint64_t bytes, const std::string& attribute) {
    const long at = std::ftell(stream_);
    if (at < 0 || bytes > file_.size() - static_cast<std::uint64_t>(at)) {
      throw file_.error("is damaged or truncated: the attribute '" + attribute +
                        "' of its header announces " + std::to_string(bytes) +
                        " bytes, more than the file holds");
    }
    std::fseek(stream_, static_cast<long>(bytes), SEEK_CUR);
  }

 private:
  const InputFile& file_;
  std::FILE* stream_;
};

}  // namespace

void check_exr_headers(const InputFile& file) {
  ExrBytes bytes(file);
  bytes.number();  // skips the magic number, by which the file was recognised
  constexpr std::uint32_t kMultiPart = 0x1000;
  const bool many = (bytes.number() & kMultiPart) != 0;
  for (bool first = true; first || many; first = false) {
    std::string attribute = bytes.name();
    if (attribute.empty()) return;
    for (; !attribute.empty(); attribute = bytes.name()) {
      bytes.name();  // skips the attribute's type
      bytes.skip(bytes.number(), attribute);
    }
  }
}

}  // namespace heightlight
