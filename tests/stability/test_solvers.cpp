#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "stability/hard_maps.h"
#include "test_maps.h"
#include "transport/gathered_ones.h"
#include "transport/simulated.h"

// Totals against a dense solution of (I − F ρ) x = E₀ in extended precision, F being taken column by column
// from the operator itself.

namespace heightlight {
namespace {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

Matrix dense_operator(const Transport& transport) {
  const std::size_t n = transport.direct.size();
  Matrix matrix(n, n);
  for (std::size_t j = 0; j < n; ++j) {
    TexelVector unit(n, 0);
    unit[j] = 1;
    const TexelVector gathered = transport.gather(unit);
    matrix.col(static_cast<Eigen::Index>(j)) = as_eigen(gathered).cast<long double>();
  }
  return matrix;
}

TexelVector dense_total(const Matrix& form_factors, const TexelVector& direct, const TexelVector& albedo) {
  const Vector reflectance = as_eigen(albedo).cast<long double>();
  const Matrix system =
      Matrix::Identity(form_factors.rows(), form_factors.cols()) - form_factors * reflectance.asDiagonal();
  const Vector source = as_eigen(direct).cast<long double>();
  const Vector total = system.partialPivLu().solve(source);
  return to_texels(total.cast<double>());
}

double largest_difference(const TexelVector& a, const TexelVector& b) {
  return (as_eigen(a) - as_eigen(b)).cwiseAbs().maxCoeff();
}

double lowest(const TexelVector& values) { return *std::min_element(values.begin(), values.end()); }
double highest(const TexelVector& values) { return *std::max_element(values.begin(), values.end()); }

TEST_CASE("totals are those of a dense solution, for albedos at their edges", "[stability]") {
  const Finder finder = GENERATE(by_rays(256), by_exact_slices(32), by_horizon_walks());
  const std::string name = GENERATE("rough", "well", "slit");
  CAPTURE(finder.name, name);
  const Heightmap map = name == "rough" ? make_rough_map(9, 9, Boundary::tile, 0.5, 0, 2)
                                        : make_map(9, 9, Boundary::open, [&](int row, int column) {
                                            const bool low = std::abs(column - 4) <= 1 &&
                                                             (name == "slit" || std::abs(row - 4) <= 1);
                                            return low ? -1000.0 : 0.0;
                                          });
  const Surface surface = build_surface(map);
  const std::unique_ptr<Transport> transport = finder.find(surface);
  const Matrix form_factors = dense_operator(*transport);
  for (const double albedo : {0.0, 0.5, 1 - 1e-7, 1.0}) {
    CAPTURE(albedo);
    const TexelVector reflectance(81, albedo);
    const TexelVector expected = dense_total(form_factors, transport->direct, reflectance);
    const Equilibrium found =
        solve_equilibrium(*transport, transport->direct, reflectance, transport->direct);
    // The residual, over 1 − ρ × the spectral radius: wells hold what falls in for many bounces.
    CHECK(largest_difference(found.irradiance, expected) < 300 * finder.residual);
    CHECK(lowest(found.irradiance) >= lowest(transport->direct) - 1e-9);
    CHECK(highest(found.irradiance) < 1 + 300 * finder.residual);
    if (albedo == 0) CHECK(found.irradiance == transport->direct);
  }
  TexelVector chequered(81);
  for (std::size_t i = 0; i < 81; ++i) chequered[i] = i % 2 == 0 ? 0 : 0.9;
  const TexelVector expected = dense_total(form_factors, transport->direct, chequered);
  const Equilibrium found = solve_equilibrium(*transport, transport->direct, chequered, transport->direct);
  CHECK(largest_difference(found.irradiance, expected) < 100 * finder.residual);
}

TEST_CASE("a well a thousand times as deep as wide keeps what falls in, and says so", "[stability]") {
  const Finder finder = GENERATE(by_rays(512), by_exact_slices(32));
  CAPTURE(finder.name);
  const Heightmap map = make_map(9, 9, Boundary::open, [](int row, int column) {
    return std::abs(row - 4) <= 1 && std::abs(column - 4) <= 1 ? -1000.0 : 0.0;
  });
  const Simulated simulated = simulate_map(map, finder);
  // Bounces die out like the radius's powers: the twentieth still brings a share that truncation would lose.
  CHECK(simulated.series.spectral_radius > 0.9);
  CHECK(simulated.series.spectral_radius < 1);
  CHECK(highest(simulated.tail.irradiance) > 0.1);
  const auto whole = as_eigen(simulated.series.sum) + as_eigen(simulated.tail.irradiance);
  CHECK(whole.minCoeff() == Approx(1).margin(1e-5));
}

TEST_CASE("totals by few gathers are right where bounces die out slowly", "[stability]") {
  const Heightmap map = make_rough_map(16, 16, Boundary::tile, 2.0, 0, 4);
  const Surface surface = build_surface(map);
  const WalkOptions walk{.azimuths = 128, .samples_per_octave = 32, .peak_share = 0.3F};
  const HorizonPlan plan{.sky = {.walk = walk}, .gather = {.walk = walk}};
  constexpr double kError = 1e-4;
  const std::unique_ptr<Transport> transport = build_horizon_transport(surface, plan, kError);
  const Matrix form_factors = dense_operator(*transport);
  for (const double albedo : {0.3, 0.8, 0.99}) {
    const TexelVector expected = dense_total(form_factors, transport->direct, TexelVector(256, albedo));
    const TexelVector found = total_of(*transport, albedo);
    const double rmse = (as_eigen(found) - as_eigen(expected)).norm() / 16;
    CAPTURE(albedo, rmse);
    CHECK(rmse < 5 * kError / (1 - albedo));
  }
}

TEST_CASE("a hundred gathers of ones: what all receivers see of ones stays one", "[stability][slow]") {
  constexpr int kSize = 128;
  constexpr int kBounces = 100;
  const Surface surface = build_surface(make_synth_map("brick", kSize, Boundary::tile, 0.2));
  const SteadyWalks transport(
      build_horizon_transport(surface, {.sky = {.walk = {.azimuths = 64, .samples_per_octave = 16}},
                                        .gather = {.walk = {.azimuths = 32, .samples_per_octave = 16}}}));
  const double row_sums = gathered_ones_error(transport);
  CHECK(row_sums < 1e-12);
  // light that is 1 everywhere is what E₀ and one bounce of it give back
  TexelVector light(std::size_t{kSize} * kSize, 1);
  for (int b = 0; b < kBounces; ++b) {
    light = transport.gather(light);
    as_eigen(light) += as_eigen(transport.direct);
  }
  CHECK((as_eigen(light).array() - 1).abs().maxCoeff() <= kBounces * row_sums);
  // and so do all bounces that start from the sky alone
  const BounceSeries series = bounce(transport, surface, kBounces, [](int, const TexelVector&) {});
  const Equilibrium tail = solve_tail(transport, series, 1);
  const auto whole = as_eigen(series.sum) + as_eigen(tail.irradiance);
  CHECK(whole.minCoeff() == Approx(1).margin(1e-6));
  CHECK(whole.maxCoeff() == Approx(1).margin(1e-6));
}

}  // namespace
}  // namespace heightlight
