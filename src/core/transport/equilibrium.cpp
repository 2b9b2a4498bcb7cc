#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "base/texel_algebra.h"
#include "heightlight/transport.h"

// x = source + F ρ x is solved as (I − F ρ) x = source. Plain iteration would make the bounces themselves and
// need ln ε / ln λ of them, thousands in a deep well; BiCGSTAB needs a few dozen products. Eigen runs it on
// any type that can be multiplied with a vector, given the traits below.

namespace heightlight {
class LossOperator;
}

namespace Eigen::internal {
template <>
struct traits<heightlight::LossOperator> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace heightlight {

/// The operator I − F diag(ρ), which is known only by its products with vectors.
class LossOperator : public Eigen::EigenBase<LossOperator> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  LossOperator(const Transport& transport, const TexelVector& albedo, Progress& progress)
      : transport_(transport), albedo_(albedo), progress_(progress) {}

  Eigen::Index rows() const { return static_cast<Eigen::Index>(albedo_.size()); }
  Eigen::Index cols() const { return rows(); }

  template <class Right>
  Eigen::Product<LossOperator, Right, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Right>& right) const {
    return {*this, right.derived()};
  }

  Eigen::VectorXd times(const Eigen::VectorXd& x) const {
    progress_.throw_if_stopped();
    progress_.add(1);
    return x - as_eigen(transport_.gather(to_texels(as_eigen(albedo_).cwiseProduct(x))));
  }

 private:
  const Transport& transport_;
  const TexelVector& albedo_;
  Progress& progress_;
};

}  // namespace heightlight

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<heightlight::LossOperator, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<heightlight::LossOperator, Right,
                                generic_product_impl<heightlight::LossOperator, Right>> {
  template <class Destination>
  static void scaleAndAddTo(Destination& destination, const heightlight::LossOperator& left,
                            const Right& right, const double& scale) {
    destination += scale * left.times(right);
  }
};
}  // namespace Eigen::internal

namespace heightlight {
namespace {

constexpr int kMostIterations = 2000;
constexpr double kTolerance = 1e-8;

}  // namespace

Equilibrium solve_equilibrium(const Transport& transport, const TexelVector& source,
                              const TexelVector& albedo, const TexelVector& guess, const Watch& watch) {
  Equilibrium result;
  const double size = as_eigen(source).norm();
  if (size == 0) {
    result.irradiance = source;
    return result;
  }
  Progress progress("equilibrium", 0, watch);
  const LossOperator loss(transport, albedo, progress);
  Eigen::BiCGSTAB<LossOperator, Eigen::IdentityPreconditioner> solver;
  solver.setTolerance(kTolerance);
  solver.setMaxIterations(kMostIterations);
  solver.compute(loss);
  const Eigen::VectorXd solution = solver.solveWithGuess(as_eigen(source), as_eigen(guess));
  result.iterations = static_cast<int>(solver.iterations());
  result.residual = (as_eigen(source) - loss.times(solution)).norm() / size;
  result.irradiance = to_texels(solution);
  return result;
}

Totals FormFactors::solve(const std::vector<IrradianceSystem>& systems, const Watch& watch) const {
  Totals totals;
  for (const IrradianceSystem& system : systems) {
    const TexelVector& source = system.direct ? *system.direct : direct;
    const TexelVector albedo = system.varying ? *system.varying : TexelVector(source.size(), system.albedo);
    Equilibrium solved = solve_equilibrium(*this, source, albedo, source, watch);
    totals.iterations = std::max(totals.iterations, solved.iterations);
    totals.residual = std::max(totals.residual, solved.residual);
    totals.irradiance.push_back(std::move(solved.irradiance));
  }
  return totals;
}

Equilibrium solve_tail(const Transport& transport, const BounceSeries& series, double albedo,
                       const Watch& watch) {
  const TexelVector constant(series.next.size(), albedo);
  Equilibrium tail = solve_equilibrium(transport, series.next, constant, series.next, watch);
  as_eigen(tail.irradiance) *= std::pow(albedo, series.bounces + 1);
  return tail;
}

}  // namespace heightlight
