#include "base/texel_algebra.h"
#include "heightlight/visibility.h"

namespace heightlight {

Vector3 bent_normal(const Vector3& first_moment, const Vector3& normal) {
  const Eigen::Vector3f first = as_eigen(first_moment);
  const float length = first.norm();
  return length > 0 ? to_vector3(Eigen::Vector3f(first / length)) : normal;
}

}  // namespace heightlight
