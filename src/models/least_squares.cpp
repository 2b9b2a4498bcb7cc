#include "models/least_squares.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <unsupported/Eigen/LevenbergMarquardt>
#include <unsupported/Eigen/NumericalDiff>

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
  const ResidualFunction& evaluate;
};

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
                                  Eigen::Index residual_count, double weight_sum,
                                  const ResidualFunction& residuals) {
  if (residual_count <= start.size()) {
    throw Error("the fit of " + what + " has " + std::to_string(residual_count) + " measurements for " +
                std::to_string(start.size()) + " parameters");
  }
  using Differentiated = Eigen::NumericalDiff<Residuals>;
  Differentiated functor(Residuals(start.size(), residual_count, residuals));
  Eigen::LevenbergMarquardt<Differentiated> solver(functor);
  solver.setMaxfev(400 * static_cast<Eigen::Index>(start.size() + 1));
  LeastSquaresFit fit;
  fit.parameters = start;
  const auto status = solver.minimize(fit.parameters);
  Eigen::VectorXd left(residual_count);
  residuals(fit.parameters, left);
  if (!converged(status) || !fit.parameters.allFinite() || !left.allFinite()) {
    throw Error("the fit of " + what + " does not converge");
  }
  Eigen::MatrixXd slopes(residual_count, start.size());
  functor.df(fit.parameters, slopes);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> decomposed(slopes);
  if (decomposed.rank() < start.size()) {
    throw Error("the fit of " + what + ": the data do not determine its parameters");
  }
  const Eigen::MatrixXd normal = slopes.transpose() * slopes;
  const double variance = left.squaredNorm() / static_cast<double>(residual_count - start.size());
  fit.covariance = variance * normal.inverse();
  fit.rms = std::sqrt(left.squaredNorm() / weight_sum);
  return fit;
}

}  // namespace heightlight
