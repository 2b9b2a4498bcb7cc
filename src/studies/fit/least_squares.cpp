#include "fit/least_squares.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "heightlight/error.h"

namespace heightlight {
namespace {

struct Residuals : Eigen::DenseFunctor<double> {
  Residuals(Eigen::Index parameters, Eigen::Index count, const ResidualFunction& function)
      : Eigen::DenseFunctor<double>(static_cast<int>(parameters), static_cast<int>(count)),
        evaluate(function) {}

  int operator()(const InputType& parameters, ValueType& values) const {
    evaluate(parameters, values);
    return 0;
  }

  /// Steps are relative, but not to parameters that happen to be near 0.
  int df(const InputType& parameters, JacobianType& slopes) const {
    constexpr double kStep = 1.5e-8;  // about √ε
    constexpr double kSmall = 1e-2;
    ValueType here(values());
    ValueType there(values());
    evaluate(parameters, here);
    for (Eigen::Index p = 0; p < parameters.size(); ++p) {
      InputType moved = parameters;
      moved[p] += kStep * std::max(std::abs(parameters[p]), kSmall);
      evaluate(moved, there);
      slopes.col(p) = (there - here) / (moved[p] - parameters[p]);
    }
    return 0;
  }

  const ResidualFunction& evaluate;
};

/// Σ_g J_gᵀ r_g r_gᵀ J_g.
Eigen::MatrixXd scatter(const Eigen::MatrixXd& slopes, const Eigen::VectorXd& left, Eigen::Index group_size) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(slopes.cols(), slopes.cols());
  for (Eigen::Index begin = 0; begin < left.size(); begin += group_size) {
    const Eigen::VectorXd score =
        slopes.middleRows(begin, group_size).transpose() * left.segment(begin, group_size);
    sum += score * score.transpose();
  }
  return sum;
}

/// Of slopes of one size: below it a parameter is told from the others by the noise of differences alone.
constexpr double kLeastPivot = 1e-6;

bool converged(Eigen::LevenbergMarquardtSpace::Status status) {
  using namespace Eigen::LevenbergMarquardtSpace;
  switch (status) {
    case RelativeReductionTooSmall:
    case RelativeErrorTooSmall:
    case RelativeErrorAndReductionTooSmall:
    case CosinusTooSmall:
    case FtolTooSmall:  // no step can be told from none any more
    case XtolTooSmall:
    case GtolTooSmall:
      return true;
    default:
      return false;
  }
}

}  // namespace

LeastSquaresFit fit_least_squares(const std::string& what, const Eigen::VectorXd& start,
                                  const ResidualShape& shape, const ResidualFunction& residuals) {
  if (shape.groups <= start.size()) {
    throw Error("the fit of " + what + " has " + std::to_string(shape.groups) + " measurements for " +
                std::to_string(start.size()) + " parameters");
  }
  const Eigen::Index measured = shape.groups * shape.group_size;
  const Eigen::Index count = measured + shape.priors;
  Residuals functor(start.size(), count, residuals);
  Eigen::LevenbergMarquardt<Residuals> solver(functor);
  solver.setMaxfev(400 * static_cast<Eigen::Index>(start.size() + 1));
  LeastSquaresFit fit;
  fit.parameters = start;
  const auto status = solver.minimize(fit.parameters);
  Eigen::VectorXd left(count);
  residuals(fit.parameters, left);
  if (!converged(status) || !fit.parameters.allFinite() || !left.allFinite()) {
    throw Error("the fit of " + what + " does not converge");
  }
  Eigen::MatrixXd slopes(count, start.size());
  functor.df(fit.parameters, slopes);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposed(slopes.colwise().normalized());
  decomposed.setThreshold(kLeastPivot);
  if (decomposed.rank() < start.size()) {
    throw Error("the fit of " + what + ": the data do not determine its parameters");
  }
  const Eigen::MatrixXd bread = (slopes.transpose() * slopes).inverse();
  const auto groups = static_cast<double>(shape.groups);
  fit.covariance = groups / (groups - static_cast<double>(start.size())) *
                   (bread * scatter(slopes.topRows(measured), left.head(measured), shape.group_size) * bread);
  fit.rms = std::sqrt(left.head(measured).squaredNorm() / shape.weight_sum);
  return fit;
}

}  // namespace heightlight
