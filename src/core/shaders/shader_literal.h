#pragma once

#include <string>

#include "base/digits.h"

namespace heightlight {

/// A number as shading languages write floats. Nine digits distinguish all floats; a point makes an integer a
/// float.
inline std::string shader_literal(double value) {
  constexpr int kDigits = 9;
  std::string text = in_digits(value, kDigits);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

}  // namespace heightlight
