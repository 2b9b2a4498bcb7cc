#pragma once

#include <array>
#include <charconv>
#include <string>
#include <type_traits>

namespace heightlight {

/// The shortest digits that read back as the same float or double, in any locale.
template <class Real>
std::string in_digits(Real value) {
  static_assert(std::is_floating_point_v<Real>);
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

/// The value with so many significant digits, in any locale.
template <class Real>
std::string in_digits(Real value, int significant) {
  static_assert(std::is_floating_point_v<Real>);
  std::array<char, 64> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value,
                                       std::chars_format::general, significant)
                             .ptr};
}

}  // namespace heightlight
