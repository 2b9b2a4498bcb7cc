#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "test_maps.h"
#include "transport/simulated.h"

// Surfaces whose light is known in closed form, by every way of finding visibility.
//
// With N rays the estimate of A in one texel errs by about 1/(2√N) times the share of directions near the
// horizon's outline; N^(-3/4) is what the lattice reaches (measured: 0.003 at 1024). Means over many texels,
// turned differently, err less. What horizon walks and exact slices err by is alike in texels that see alike,
// and averages away little; it comes from where walks look (simulated.h), and from the number of azimuths
// only where a horizon is not smooth in the azimuth.

namespace heightlight {
namespace {

TEST_CASE("a flat map is open everywhere and has no links", "[transport][analytic]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Finder finder = GENERATE(by_rays(256), by_horizon_walks(), by_exact_slices(32));
  CAPTURE(finder.name);
  const Simulated flat = simulate_map(make_map(9, 6, boundary, [](int, int) { return 0.7; }), finder);
  CHECK(flat.transport->link_count() == 0);
  for (std::size_t i = 0; i < flat.transport->sky_view_factor.size(); ++i) {
    CHECK(flat.transport->sky_view_factor.values[i] == 1);
    CHECK(flat.transport->ambient_occlusion.values[i] == 1);
  }
  CHECK(as_eigen(flat.tail.irradiance).isZero(0));
  CHECK(flat.series.spectral_radius == 0);
}

TEST_CASE("an open tilted plane sees only sky, also below the horizontal", "[transport][analytic]") {
  const auto [finder, tolerance] = GENERATE(table<Finder, double>(
      {// identity, up to rays so flat over the plane (cosθ < 10⁻⁴) that rounding of the heights decides
       {by_rays(256), 1e-4 * 1e-4},
       {by_horizon_walks(), 1e-6},       // rounding of sums in single precision
       {by_exact_slices(32), 1e-12}}));  // rounding of the normal, squared
  CAPTURE(finder.name);
  const Simulated plane = simulate_map(
      make_map(33, 21, Boundary::open, [](int row, int column) { return 0.05 * column + 0.02 * row; }),
      finder);
  CHECK((as_eigen(plane.bounces[0]).array() - 1).abs().maxCoeff() < tolerance);
  CHECK(as_eigen(plane.bounces[1]).maxCoeff() < tolerance);
}

/// A at distance `left` and `right` (texels) from walls of `depth` texels: each hides 1 − cos β of its half
/// of the sky, β being its elevation in the profile.
double between_walls(double left, double right, double depth) {
  return 0.5 * (left / std::hypot(left, depth) + right / std::hypot(right, depth));
}

TEST_CASE("the floor of an infinite trench sees the half sum of the cosines to its rims",
          "[transport][analytic]") {
  constexpr int kSize = 64;
  constexpr double kDepth = 0.25;
  Heightmap map = make_map(kSize, kSize, Boundary::tile,
                           [&](int, int column) { return column >= 24 && column <= 40 ? 0.0 : kDepth; });
  const auto [finder, tolerance] = GENERATE(table<Finder, double>(
      {// Monte Carlo: 64 texels with differently turned rays, 0.003/√64; five times that
       {by_rays(1024), 2e-3},
       // discretisation: beyond ν/4 texels walks that run more along the trench than across it meet the rim
       // only where they cross a row, and interpolate between it and the floor: a rim stands up to a texel
       // farther away for them, or a little lower (measured: 5.3e-3 and 4e-4)
       {by_horizon_walks(32), 7e-3},
       {by_horizon_walks(128), 8e-4},
       // identity: equal steps in the azimuth integrate a smooth periodic function faster than any power
       {by_exact_slices(128), 1e-12}}));
  CAPTURE(finder.name);
  const Simulated trench = simulate_map(std::move(map), finder, 2);
  for (int column = 25; column < 40; ++column) {
    double mean = 0;
    for (int row = 0; row < kSize; ++row) mean += trench.bounces[0][row * kSize + column] / kSize;
    CHECK(mean == Approx(between_walls(column - 23, 41 - column, kDepth * kSize)).margin(tolerance));
  }
  const double cos_beta = 9 / std::hypot(9.0, kDepth * kSize);
  double centre = 0;
  for (int row = 0; row < kSize; ++row) centre += trench.bounces[0][row * kSize + 32] / kSize;
  CHECK(centre == Approx(cos_beta).margin(tolerance));
}

TEST_CASE("at the foot of a cliff the sky loses half of 1 - cos of its elevation", "[transport][analytic]") {
  // Open and 512 units long, so that the ends, (depth/length)² of the wall's share, do not show.
  constexpr int kRows = 129;
  constexpr int kDepth = 8;
  Heightmap map = make_map(33, kRows, Boundary::open,
                           [&](int, int column) { return column < 20 ? 0.0 : double{kDepth}; });
  map.spacing = {1, 4};
  const auto [finder, tolerance] = GENERATE(table<Finder, double>(
      {{by_rays(1024), 3e-3},            // Monte Carlo: 21 texels
       {by_horizon_walks(), 1e-3},       // discretisation as in the trench (measured: 2.5e-4)
       {by_exact_slices(128), 3e-5}}));  // discretisation: third order at the cliff's own azimuth
  CAPTURE(finder.name);
  const Simulated cliff = simulate_map(std::move(map), finder, 1);
  for (int column = 0; column < 19; ++column) {
    double mean = 0;
    for (int row = 54; row <= 74; ++row) mean += cliff.bounces[0][row * 33 + column] / 21;
    const double distance = 20 - column;
    const double cosine = distance / std::hypot(distance, kDepth);
    CHECK(mean == Approx(0.5 * (1 + cosine)).margin(tolerance));
  }
}

/// Bounces in an infinite V-groove by its 2-D integral equation. Both faces, of unit length from the bottom
/// and at `slope_rad` above the horizontal, are cut into `n` strips; a point sees the strip between the
/// angles a and b from its normal as the form factor (sin b − sin a)/2. By symmetry both faces are alike.
std::vector<std::vector<double>> groove_bounces(double slope_rad, int n, int bounces) {
  const auto strips = static_cast<std::size_t>(n);
  const double c = std::cos(slope_rad);
  const double s = std::sin(slope_rad);
  // The point at distance x on the right face, (x c, x s), with normal (−s, c), sees (−y c, y s) on the left
  // one.
  const auto sine_to = [&](double x, double y) {
    const double dx = -(x + y) * c;
    const double dz = (y - x) * s;
    const double along_face = dx * c + dz * s;  // the face's direction (c, s): the sine from the normal
    return along_face / std::hypot(dx, dz);
  };
  std::vector<std::vector<double>> result(1, std::vector<double>(strips));
  const auto centre = [&](std::size_t i) { return (static_cast<double>(i) + 0.5) / n; };
  for (std::size_t i = 0; i < strips; ++i) result[0][i] = 0.5 * (1 - sine_to(centre(i), 1.0));
  for (int b = 1; b <= bounces; ++b) {
    std::vector<double> next(strips, 0);
    for (std::size_t i = 0; i < strips; ++i) {
      for (std::size_t j = 0; j < strips; ++j) {
        const double share = 0.5 * (sine_to(centre(i), (static_cast<double>(j) + 1) / n) -
                                    sine_to(centre(i), static_cast<double>(j) / n));
        next[i] += std::fabs(share) * result.back()[j];
      }
    }
    result.push_back(next);
  }
  return result;
}

TEST_CASE("bounces in a V-groove match its 2-D integral equation", "[transport][analytic][slow]") {
  constexpr int kHalf = 32;  // texels from the bottom to the rim
  // Rays average over rows, slices are the same in all of them.
  const auto [finder, rows] =
      GENERATE(table<Finder, int>({{by_rays(1024), 64}, {by_horizon_walks(), 64}, {by_exact_slices(64), 4}}));
  CAPTURE(finder.name);
  // Tiled grooves touch at their rims, which stand at one height: the sky begins at the opposite rim.
  Heightmap map =
      make_map(2 * kHalf, rows, Boundary::tile, [](int, int column) { return std::abs(column - kHalf); });
  map.spacing = {1, 1};
  const Simulated groove = simulate_map(std::move(map), finder, 3);
  const auto expected = groove_bounces(std::numbers::pi / 4, 640, 3);
  for (std::size_t b = 0; b <= 3; ++b) {
    for (int k = 3; k < kHalf - 2;
         k += 4) {  // off the crease and the rim, whose vertices have a smooth normal
      double mean = 0;
      for (int row = 0; row < rows; ++row) mean += groove.bounces[b][row * 2 * kHalf + kHalf + k] / rows;
      const double strip = static_cast<double>(k) / kHalf * 640;
      const auto below = static_cast<std::size_t>(strip - 0.5);
      const double reference = 0.5 * (expected[b][below] + expected[b][below + 1]);
      // Monte Carlo as above; discretisation of the last texel at the rim and the first at the crease, 1/32
      // of the face with an error of a tenth there
      CHECK(mean == Approx(reference).margin(4e-3));
    }
  }
}

struct BowlError {
  double ring =
      0;  ///< largest, of means over rings of equal distance: the rays' noise does not hide the mesh's error
  double texel = 0;  ///< largest of all
};

/// Error of E_b/π = (1 − f) f^b, f = depth/2R, b = 0 … 20, at the texels more than two from the rim.
BowlError bowl_error(int size, const Finder& finder) {
  const double depth = 0.25;
  const double rim = 0.35;
  const double f = depth / ((rim * rim + depth * depth) / depth);
  const Simulated bowl = simulate_map(make_synth_map("bowl", size, Boundary::open, depth), finder);
  BowlError worst;
  for (std::size_t b = 0; b <= 20; ++b) {
    const double expected = (1 - f) * std::pow(f, b);
    std::vector<double> sum(8, 0);
    std::vector<int> count(8, 0);
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column) {
        const double distance = std::hypot((row + 0.5) / size - 0.5, (column + 0.5) / size - 0.5);
        if (distance > rim - 2.0 / size) continue;
        const double error = bowl.bounces[b][row * size + column] - expected;
        const auto ring = static_cast<std::size_t>(distance / rim * 8);
        sum[ring] += error;
        ++count[ring];
        worst.texel = std::max(worst.texel, std::fabs(error));
      }
    }
    for (std::size_t ring = 0; ring < 8; ++ring) {
      if (count[ring] > 0) worst.ring = std::max(worst.ring, std::fabs(sum[ring] / count[ring]));
    }
  }
  return worst;
}

TEST_CASE("in a spherical pit every bounce is uniform, and the error falls with the texel",
          "[transport][analytic][slow]") {
  const Finder finder = GENERATE(by_rays(1024), by_horizon_walks(), by_exact_slices(16));
  CAPTURE(finder.name);
  const BowlError coarse = bowl_error(32, finder);
  const BowlError middle = bowl_error(64, finder);
  const BowlError fine = bowl_error(128, finder);
  INFO("ring errors " << coarse.ring << ", " << middle.ring << ", " << fine.ring);
  CHECK(fine.ring < middle.ring);
  CHECK(middle.ring < coarse.ring);
  // discretisation: first order, the ring of texels across the rim being a share of the map that falls as
  // 1/size (measured with 4096 rays, 32² to 256²: 0.0156, 0.0076, 0.0043, 0.0020)
  CHECK(coarse.ring / fine.ring > 2);
  CHECK(fine.ring < 6e-3);
  // the mesh's error next to the rim, and four times the rays' noise of 0.003
  CHECK(coarse.texel < 0.017 + 0.012);
  CHECK(fine.texel < 0.0065 + 0.012);
}

}  // namespace
}  // namespace heightlight
