#include "base/byte_size.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

#include "heightlight/error.h"

namespace heightlight {

std::uint64_t parse_byte_size(const std::string& text) {
  std::size_t used = 0;
  double number = -1;
  try {
    number = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  std::string unit = text.substr(used);
  std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
  const std::string letters = "kmgt";
  double scale = 1;
  bool known = unit.empty() || unit == "b";
  if (!known) {
    const std::size_t power = letters.find(unit[0]);
    const std::string rest = unit.substr(1);
    known = power != std::string::npos && (rest.empty() || rest == "b" || rest == "ib");
    scale = std::pow(1024.0, static_cast<double>(power + 1));
  }
  const double bytes = number * scale;
  if (used == 0 || !known || !(bytes >= 1) || bytes > 9e18) {
    throw UsageError("'" + text + "' is not an amount of memory; write it like 8G, 512M or 1000000");
  }
  return static_cast<std::uint64_t>(bytes);
}

std::string format_byte_size(std::uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits{"bytes", "KiB", "MiB", "GiB", "TiB"};
  double value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 1024 && unit + 1 < kUnits.size()) {
    value /= 1024;
    ++unit;
  }
  std::array<char, 48> digits{};
  const int precision = unit == 0 ? 0 : 1;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, precision);
  return std::string(digits.data(), end.ptr) + " " + kUnits[unit];
}

std::string write_enough(std::uint64_t bytes) {
  constexpr std::uint64_t kMebi = 1 << 20;
  return std::to_string((bytes + kMebi - 1) / kMebi) + "M";
}

std::uint64_t peak_memory() {
  // The peak that getrusage tells also counts what the process held before it became this program.
  std::ifstream status("/proc/self/status");
  for (std::string key; status >> key;) {
    std::uint64_t kibibytes = 0;
    if (key == "VmHWM:" && status >> kibibytes) return kibibytes * 1024;
    status.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return 0;
}

}  // namespace heightlight
