#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "heightlight/image.h"

// Conversions between plain values and Eigen's types.

namespace heightlight {

inline Eigen::Map<const Eigen::VectorXd> as_eigen(const TexelVector& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

inline Eigen::Map<Eigen::VectorXd> as_eigen(TexelVector& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

inline Eigen::Vector3f as_eigen(const Vector3& vector) { return {vector.x, vector.y, vector.z}; }

inline Vector3 to_vector3(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// The largest power of two that the largest |x| reaches, clamped to 2^±1000; 1 where all x are 0. In this
/// unit, numbers of any magnitude that double precision has fit into single precision, and dividing by it
/// loses no bit.
inline double unit_of(const TexelVector& x) {
  const double largest = x.empty() ? 0 : as_eigen(x).cwiseAbs().maxCoeff();
  int exponent = 0;
  std::frexp(largest, &exponent);
  return largest > 0 ? std::ldexp(1.0, std::clamp(exponent - 1, -1000, 1000)) : 1;
}

/// The value of an expression.
template <class Expression>
TexelVector to_texels(const Eigen::MatrixBase<Expression>& expression) {
  TexelVector values(static_cast<std::size_t>(expression.size()));
  as_eigen(values) = expression;
  return values;
}

}  // namespace heightlight
