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
  Eigen::MatrixXd covariance;  ///< σ² (JᵀJ)⁻¹ with σ² = Σ r²/(residuals − parameters)
  double rms = 0;              ///< √(Σ r²/Σ w), given the sum of the weights
};

/// Minimises Σ r² from `start` by Levenberg and Marquardt's method (Eigen), with forward differences. Throws
/// Error naming `what` where residuals are not more than parameters, where it does not converge within 400
/// steps a parameter or leaves the finite, and where the data leave a parameter undetermined (JᵀJ is
/// singular).
LeastSquaresFit fit_least_squares(const std::string& what, const Eigen::VectorXd& start,
                                  Eigen::Index residual_count, double weight_sum,
                                  const ResidualFunction& residuals);

}  // namespace heightlight
