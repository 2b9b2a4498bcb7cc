#pragma once

#include <cmath>

#include "base/texel_algebra.h"

namespace heightlight {

/// Root mean square over the texels.
template <class Expression>
double rms(const Eigen::MatrixBase<Expression>& x) {
  return x.norm() / std::sqrt(static_cast<double>(x.size()));
}

inline double rms(const TexelVector& x) { return rms(as_eigen(x)); }

}  // namespace heightlight
