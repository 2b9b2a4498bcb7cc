#include "report/packed_levels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "files/deflated.h"

namespace heightlight {
namespace {

constexpr int kMissingLevel = 65535;
constexpr double kMostLevels = 65000;
constexpr int kFloatDigits = 6;

std::string encode_base64(const std::string& bytes) {
  static constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? std::uint32_t{static_cast<unsigned char>(bytes[i + k])} : 0U;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

/// What the neighbours before a cell let expect: the mean of the left and the upper one, as far as they are
/// there.
int expected_level(const Image<std::uint16_t>& levels, int row, int column) {
  if (row == 0) return column == 0 ? 0 : levels(row, column - 1);
  if (column == 0) return levels(row - 1, column);
  return (levels(row, column - 1) + levels(row - 1, column)) / 2;
}

/// Small differences of either sign as small numbers, modulo 65536.
std::uint16_t fold_sign(int difference) {
  const auto wrapped = static_cast<std::int16_t>(static_cast<std::uint16_t>(difference));
  return static_cast<std::uint16_t>(wrapped < 0 ? -2 * wrapped - 1 : 2 * wrapped);
}

std::string pack(const Image<std::uint16_t>& levels) {
  std::string bytes(2 * levels.size(), '\0');
  for (int row = 0; row < levels.height; ++row) {
    for (int column = 0; column < levels.width; ++column) {
      const std::uint16_t folded = fold_sign(levels(row, column) - expected_level(levels, row, column));
      const std::size_t i = levels.index(row, column);
      bytes[i] = static_cast<char>(folded & 255);
      bytes[levels.size() + i] = static_cast<char>(folded >> 8);
    }
  }
  return encode_base64(deflate_bytes(bytes));
}

/// The least and the greatest value; the former above the latter where there is none.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(const Map& map) {
    for (const float value : map.values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, static_cast<double>(value));
      high = std::max(high, static_cast<double>(value));
    }
  }
};

}  // namespace

int choose_decimals(const std::vector<Map>& maps) {
  Extent extent;
  for (const Map& map : maps) extent.add(map);
  const double largest = std::max(std::abs(extent.low), std::abs(extent.high));
  if (extent.low > extent.high || largest == 0) return 0;
  const int told = kFloatDigits - static_cast<int>(std::ceil(std::log10(largest)));
  if (extent.high == extent.low) return told;
  return std::min(told, static_cast<int>(std::floor(std::log10(kMostLevels / (extent.high - extent.low)))));
}

PackedLevels pack_levels(const Map& map, int decimals) {
  Extent extent;
  extent.add(map);
  const double scale = std::pow(10.0, decimals);
  PackedLevels packed{.base = extent.low > extent.high ? 0 : std::llround(extent.low * scale)};
  Image<std::uint16_t> levels(map.width, map.height);
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double value = static_cast<double>(map.values[i]);
    const std::int64_t level =
        std::isfinite(value) ? std::llround(value * scale) - packed.base : kMissingLevel;
    assert(level >= 0 && level <= kMissingLevel);
    levels.values[i] = static_cast<std::uint16_t>(level);
  }
  packed.data = pack(levels);
  return packed;
}

}  // namespace heightlight
