#include "visibility/sky_harmonics.h"

#include <cmath>
#include <numbers>

namespace heightlight {

Harmonics harmonics_of_moments(double sky_view_factor, const Eigen::Vector3d& first,
                               const std::array<double, 5>& second) {
  constexpr double kPi = std::numbers::pi;
  const double y0 = 0.5 / std::sqrt(kPi);
  const double y1 = std::sqrt(0.75 / kPi);
  const double y2 = 0.5 * std::sqrt(15 / kPi);
  return {y0 * sky_view_factor,
          y1 * first.y(),
          y1 * first.z(),
          y1 * first.x(),
          y2 * second[1],
          y2 * second[4],
          0.25 * std::sqrt(5 / kPi) * (3 * second[2] - sky_view_factor),
          y2 * second[3],
          0.5 * y2 * second[0]};
}

Harmonics harmonics_of(const Eigen::Vector3d& d) {
  return harmonics_of_moments(
      1, d, {d.x() * d.x() - d.y() * d.y(), d.x() * d.y(), d.z() * d.z(), d.x() * d.z(), d.y() * d.z()});
}

Harmonics turn_y(const Harmonics& harmonics) {
  Harmonics turned = harmonics;
  for (const std::size_t odd : {1, 4, 5}) turned[odd] = -turned[odd];
  return turned;
}

double dot(const Harmonics& a, const Harmonics& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace heightlight
