#pragma once

#include <cmath>

namespace heightlight {

/// IEC 61966-2-1: the linear value of an encoded one, both in [0, 1].
inline double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

/// The encoded value of a linear one, both in [0, 1].
inline double linear_to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace heightlight
