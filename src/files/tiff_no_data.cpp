#include "files/tiff_no_data.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>

#include "files/input_file.h"

namespace heightlight {
namespace {

/// Reads a TIFF's numbers in its own byte order. Past the end everything is zero, which ends every search.
class TiffBytes {
 public:
  explicit TiffBytes(std::FILE* file) : file_(file) {
    is_little_endian_ = number(0, 1) == 'I';
    is_big_tiff_ = number(2, 2) == 43;
  }

  bool is_big_tiff() const { return is_big_tiff_; }

  std::uint64_t number(std::uint64_t offset, int size) {
    const std::string bytes = text(offset, static_cast<std::size_t>(size));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t place = is_little_endian_ ? bytes.size() - 1 - i : i;
      value = value << 8 | static_cast<unsigned char>(bytes[place]);
    }
    return value;
  }

  std::string text(std::uint64_t offset, std::size_t size) {
    std::string bytes(size, '\0');
    if (std::fseek(file_, static_cast<long>(offset), SEEK_SET) != 0) return bytes;
    const std::size_t got = std::fread(bytes.data(), 1, size, file_);
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(got), bytes.end(), '\0');
    return bytes;
  }

 private:
  std::FILE* file_;
  bool is_little_endian_ = true;
  bool is_big_tiff_ = false;
};

std::optional<double> parse_number(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" +");
  if (start == std::string::npos) return std::nullopt;
  double value = 0;
  const auto result = std::from_chars(text.data() + start, text.data() + text.size(), value);
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> read_tiff_no_data(const std::filesystem::path& path) {
  constexpr std::uint64_t kNoDataTag = 42113;
  constexpr std::uint64_t kLongestNumber = 64;
  const File file = open_input(path);
  TiffBytes tiff(file.get());
  // Classic TIFF has 12-byte entries with 4-byte values, BigTIFF 20-byte entries with 8-byte values.
  const bool big = tiff.is_big_tiff();
  const int word = big ? 8 : 4;
  const std::uint64_t directory = tiff.number(big ? 8 : 4, word);
  const std::uint64_t entries = tiff.number(directory, big ? 8 : 2);
  std::uint64_t entry = directory + (big ? 8 : 2);
  for (std::uint64_t i = 0; i < entries; ++i, entry += big ? 20 : 12) {
    const std::uint64_t tag = tiff.number(entry, 2);
    if (tag == 0) break;
    if (tag != kNoDataTag) continue;
    const std::uint64_t length = tiff.number(entry + 4, word);
    const std::uint64_t value = entry + 4 + static_cast<std::uint64_t>(word);
    if (length > kLongestNumber) return std::nullopt;
    const std::uint64_t place = length <= static_cast<std::uint64_t>(word) ? value : tiff.number(value, word);
    return parse_number(tiff.text(place, length));
  }
  return std::nullopt;
}

}  // namespace heightlight
