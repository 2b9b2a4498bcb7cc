#include "visibility/sky_harmonics.h"

namespace heightlight {

Harmonics harmonics_of_moments(double sky_view_factor, const Eigen::Vector3d& first,
                               const std::array<double, 5>& second) {
  return harmonics_from_moments<double>(sky_view_factor, {first.x(), first.y(), first.z()}, second);
}

Harmonics harmonics_of(const Eigen::Vector3d& d) { return harmonics_along<double>({d.x(), d.y(), d.z()}); }

Harmonics turn_y(const Harmonics& harmonics) {
  Harmonics turned = harmonics;
  for (const std::size_t odd : {1, 4, 5}) turned[odd] = -turned[odd];
  return turned;
}

}  // namespace heightlight
