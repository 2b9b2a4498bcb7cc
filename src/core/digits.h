#pragma once

#include <array>
#include <charconv>
#include <string>

namespace heightlight {

/// The shortest digits that read back as the same double, in any locale.
inline std::string in_digits(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

}  // namespace heightlight
