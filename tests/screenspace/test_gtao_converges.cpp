#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "base/parallel.h"
#include "heightlight/files.h"
#include "heightlight/screenspace.h"
#include "screenspace/gtao_kernel.h"
#include "shared_data.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"

// GTAO against exact walks on large maps, on every 64th row, and how its error falls.
//
// Slices. The horizon is a continuous function of the azimuth, since it is the largest slope of a continuous
// profile, with kinks where one part of the surface takes over from another: K equal steps of it err by
// O(1/K²) once the facets that make horizons are wider than a step, and by O(1/K) before, when the next edge
// is as good as a jump. Steps. What N samples find is never above the horizon, and below it by what the
// profile's highest kink, somewhere between two samples, rises above them: in proportion to their distance,
// O(1/N), always towards too open.

namespace heightlight {
namespace {

constexpr int kRowStep = 64;

struct Convergence {
  double rmse = 0;
  double ambient_rmse = 0;
  double bias = 0;
  double bent_rmse_deg = 0;
};

Convergence measure_rows(const Surface& surface, int slices, int steps, const ExactWalker& walker) {
  const DepthBuffer depth = make_depth_buffer(surface);
  const SliceTables tables =
      make_slice_tables(depth,
                        {slices, steps, StepDistribution::quadratic, DepthSampling::mesh,
                         DirectionNoise::none, std::numeric_limits<double>::infinity()},
                        0);
  const int rows = surface.height() / kRowStep;
  std::vector<Convergence> sums(static_cast<std::size_t>(rows));
  parallel_for(rows, [&](std::int64_t i) {
    const int row = static_cast<int>(i) * kRowStep + kRowStep / 2;
    const std::vector<float> none(static_cast<std::size_t>(surface.width()));
    GtaoSums found{none, none, none, {none, none, none}};
    gtao_row({depth, tables}, row, found);
    Convergence& sum = sums[static_cast<std::size_t>(i)];
    SliceView view;
    for (int column = 0; column < surface.width(); ++column) {
      walker.view(row, column, view);
      const auto j = static_cast<std::size_t>(column);
      const double error = double{found.sky[j]} / double{found.open[j]} - view.sky_view_factor;
      const Eigen::Vector3d bent =
          Eigen::Vector3f(found.bent[0][j], found.bent[1][j], found.bent[2][j]).cast<double>();
      const double angle = std::atan2(bent.cross(view.bent_normal).norm(), bent.dot(view.bent_normal));
      const double open_share = double{found.solid[j]} / (2.0 * slices);
      sum.rmse += error * error;
      sum.ambient_rmse += std::pow(open_share - view.ambient_occlusion, 2);
      sum.bias += error;
      sum.bent_rmse_deg += std::pow(angle * 180 / std::numbers::pi, 2);
    }
  });
  Convergence all;
  for (const Convergence& sum : sums) {
    all.rmse += sum.rmse;
    all.ambient_rmse += sum.ambient_rmse;
    all.bias += sum.bias;
    all.bent_rmse_deg += sum.bent_rmse_deg;
  }
  const double count = static_cast<double>(rows) * surface.width();
  return {.rmse = std::sqrt(all.rmse / count),
          .ambient_rmse = std::sqrt(all.ambient_rmse / count),
          .bias = all.bias / count,
          .bent_rmse_deg = std::sqrt(all.bent_rmse_deg / count)};
}

void check_convergence(const Surface& surface) {
  const ExactWalker walker(surface, 512);
  double before = 1;
  double bias_before = 1;
  for (const int steps : {64, 256, 1024}) {
    const Convergence at = measure_rows(surface, 64, steps, walker);
    INFO(steps << " steps: RMSE " << at.rmse << ", bias " << at.bias << ", bent normal " << at.bent_rmse_deg);
    CHECK(at.bias > 0);
    // discretisation: first order in steps would be a quarter; kinks closer than the steps cost a little
    CHECK(at.rmse < 0.4 * before);
    CHECK(at.bias < 0.35 * bias_before);
    before = at.rmse;
    bias_before = at.bias;
    if (steps < 1024) continue;
    CHECK(at.rmse <= 1e-3);
    CHECK(at.ambient_rmse <= 2e-3);  // without the cosine, grazing horizons count for more
    CHECK(at.bent_rmse_deg < 0.5);
  }
}

TEST_CASE("GTAO converges to the exact walk on a brick wall of 512²", "[screenspace][slow]") {
  check_convergence(build_surface(make_synth_map("brick", 512, Boundary::tile, 0.1)));
}

TEST_CASE("GTAO converges to the exact walk on Ground054 at 512²", "[screenspace][slow]") {
  const auto path = find_shared_data("material/Ground054_height16.png");
  if (!path) return;
  LoadOptions options;
  options.shrink = 2;
  check_convergence(build_surface(load_heightmap(*path, options, std::uint64_t{1} << 32).map));
}

TEST_CASE("GTAO's error falls with the slices between first and second order", "[screenspace][slow]") {
  const Surface surface = build_surface(make_synth_map("brick", 256, Boundary::tile, 0.1));
  const ExactWalker walker(surface, 512);
  double before = 1;
  for (const int slices : {2, 8, 32}) {
    const double rmse = measure_rows(surface, slices, 1024, walker).rmse;
    INFO(slices << " slices: " << rmse);
    CHECK(rmse < 0.3 * before);  // discretisation: first order would be a quarter, second a sixteenth
    before = rmse;
  }
}

}  // namespace
}  // namespace heightlight
