#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

namespace heightlight {

/// Weighted residuals r of a model at parameters p: r_i = √w_i (model_i − measured_i). The size of r is
/// fixed.
using ResidualFunction = std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals)>;

struct LeastSquaresFit {
  Eigen::VectorXd parameters;
  Eigen::MatrixXd covariance;  ///< allows for residuals of one group that err together
  double rms = 0;              ///< √(Σ r²/Σ w) over the measurements, given the sum of the weights
};

/// How residuals belong together.
struct ResidualShape {
  Eigen::Index groups = 0;      ///< measurements that err independently of each other
  Eigen::Index group_size = 1;  ///< residuals of each, which may err together: consecutive in r
  Eigen::Index priors = 0;      ///< residuals after those: what is known of the parameters beforehand
  double weight_sum = 1;        ///< Σ w, over all residuals but those
};

/// Minimises Σ r² from `start` by Levenberg and Marquardt's method (Eigen), with forward differences. The
/// covariance is (JᵀJ)⁻¹ (Σ_g J_gᵀ r_g r_gᵀ J_g) (JᵀJ)⁻¹ over the groups g, times groups/(groups −
/// parameters). Throws Error naming `what` where groups are not more than parameters, where it does not
/// converge within 400 steps a parameter or leaves the finite, and where the data leave a parameter
/// undetermined (JᵀJ is singular).
LeastSquaresFit fit_least_squares(const std::string& what, const Eigen::VectorXd& start,
                                  const ResidualShape& shape, const ResidualFunction& residuals);

}  // namespace heightlight
