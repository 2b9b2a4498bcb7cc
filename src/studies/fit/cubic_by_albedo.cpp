#include "fit/cubic_by_albedo.h"

#include <Eigen/QR>
#include <cmath>

#include "heightlight/error.h"

namespace heightlight {

std::vector<AlbedoCubic> fit_cubics(const std::vector<FitPoint>& points, const std::vector<double>& albedos) {
  const auto rows = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd powers(rows, 3);
  Eigen::MatrixXd measured(rows, static_cast<Eigen::Index>(albedos.size()));
  double weights = 0;
  for (Eigen::Index i = 0; i < rows; ++i) {
    const FitPoint& point = points[static_cast<std::size_t>(i)];
    const double sky = point.inputs.sky_view_factor.value;
    const double root = std::sqrt(point.weight);
    powers.row(i) << root * sky * sky * sky, -root * sky * sky, root * sky;
    for (Eigen::Index k = 0; k < measured.cols(); ++k) {
      measured(i, k) = root * point.measured[static_cast<std::size_t>(k)];
    }
    weights += point.weight;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposed(powers);
  if (rows < 4 || decomposed.rank() < 3) throw Error("the fit of cubics: the data do not determine them");
  const Eigen::MatrixXd coefficients = decomposed.solve(measured);
  const Eigen::MatrixXd left = powers * coefficients - measured;
  std::vector<AlbedoCubic> cubics;
  for (Eigen::Index k = 0; k < measured.cols(); ++k) {
    cubics.push_back({albedos[static_cast<std::size_t>(k)], coefficients(0, k), coefficients(1, k),
                      coefficients(2, k), std::sqrt(left.col(k).squaredNorm() / weights)});
  }
  return cubics;
}

}  // namespace heightlight
