#include "files/no_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>

namespace heightlight {
namespace {

constexpr double kBeyondHeights = 1e38;

template <class Integer>
std::optional<double> nearest_integer(double value) {
  const double rounded = std::nearbyint(value);
  if (!(rounded >= static_cast<double>(std::numeric_limits<Integer>::min()) &&
        rounded <= static_cast<double>(std::numeric_limits<Integer>::max())))
    return std::nullopt;
  return rounded;
}

std::optional<double> nearest_float(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (std::abs(value) > kLargest) return std::copysign(kLargest, value);
  return static_cast<double>(static_cast<float>(value));
}

/// The nearest half: 11 significant bits, exponent at least −14.
std::optional<double> nearest_half(double value) {
  constexpr double kLargest = 65504;
  if (std::abs(value) > kLargest) return std::nullopt;  // no half is that large
  const double unit = std::ldexp(1, (value == 0 ? -14 : std::max(std::ilogb(value), -14)) - 10);
  return std::nearbyint(value / unit) * unit;
}

}  // namespace

std::optional<double> as_stored(double value, const std::string& sample_type) {
  if (std::isnan(value)) return std::nullopt;
  if (sample_type == "uint8") return nearest_integer<std::uint8_t>(value);
  if (sample_type == "int8") return nearest_integer<std::int8_t>(value);
  if (sample_type == "uint16") return nearest_integer<std::uint16_t>(value);
  if (sample_type == "int16") return nearest_integer<std::int16_t>(value);
  if (sample_type == "uint32") return nearest_integer<std::uint32_t>(value);
  if (sample_type == "int32") return nearest_integer<std::int32_t>(value);
  if (sample_type == "half") return nearest_half(value);
  if (sample_type == "double") return value;
  return nearest_float(value);
}

std::size_t drop_no_data(double no_data, const std::string& sample_type, Image<double>& values) {
  const std::optional<double> stored = as_stored(no_data, sample_type);
  if (!stored) return 0;
  std::size_t dropped = 0;
  const bool is_text = sample_type == "text";
  for (double& value : values.values) {
    const double sample = is_text ? nearest_float(value).value_or(value) : value;
    const bool beyond =
        std::abs(*stored) >= kBeyondHeights && sample / *stored > 0 && std::abs(sample) >= kBeyondHeights;
    if (sample != *stored && !beyond) continue;
    value = std::numeric_limits<double>::quiet_NaN();
    ++dropped;
  }
  return dropped;
}

std::optional<double> parse_no_data(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\n\r+");
  const std::size_t last = text.find_last_not_of(" \t\n\r");
  if (first == std::string::npos) return std::nullopt;
  double value = 0;
  const char* const end = text.data() + last + 1;
  const auto [stop, fault] = std::from_chars(text.data() + first, end, value);
  if (fault == std::errc::result_out_of_range) return std::nullopt;
  if (fault != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace heightlight
