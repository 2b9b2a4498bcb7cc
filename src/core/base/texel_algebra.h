#pragma once

#include <Eigen/Core>

#include "heightlight/image.h"

// Plain values, as Eigen calculates with them.

namespace heightlight {

inline Eigen::Map<const Eigen::VectorXd> as_eigen(const TexelVector& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

inline Eigen::Map<Eigen::VectorXd> as_eigen(TexelVector& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

inline Eigen::Vector3f as_eigen(const Vector3& vector) { return {vector.x, vector.y, vector.z}; }

inline Vector3 to_vector3(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// What an expression comes to.
template <class Expression>
TexelVector to_texels(const Eigen::MatrixBase<Expression>& expression) {
  TexelVector values(static_cast<std::size_t>(expression.size()));
  as_eigen(values) = expression;
  return values;
}

}  // namespace heightlight
