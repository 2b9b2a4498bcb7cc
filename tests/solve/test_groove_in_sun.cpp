#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/gauss_legendre.h"
#include "heightlight/solve.h"
#include "heightlight/sun.h"
#include "test_maps.h"

using namespace heightlight;
using std::numbers::pi;

namespace {

/// Grooves side by side, without end along y, whose walls rise at `slope` over half of `columns` samples.
/// None sees beyond its ridges, which stand at one height.
Surface make_grooves(int columns, double slope) {
  Heightmap map = make_map(columns, 4, Boundary::tile, [&](int, int column) {
    return slope * std::abs(column - columns / 2) / columns;  // width 1
  });
  return build_surface(std::move(map));
}

/// E/π on both walls of a groove, by their integral equations.
///
/// Walls are strips without end that meet at the angle γ. What a strip at the distance x from the valley sees
/// of one at t on the other wall is K(x, t) dt with
///     K = sin²γ x t/(2 (x² + t² − 2 x t cosγ)^{3/2}),
/// which sums over t from 0 to ∞ to (1 + cosγ)/2.
class GrooveEquation {
 public:
  GrooveEquation(double opening, double length) : opening_(opening) {
    // Panels shrink toward the valley, where the kernel only depends on t/x.
    for (double end = length, begin; end > 1e-5 * length; end = begin) {
      begin = end / 1.6;
      for (const QuadratureNode& node : gauss_legendre(8)) {
        places_.push_back(begin + node.at * (end - begin));
        weights_.push_back(node.weight * (end - begin));
      }
    }
  }

  /// Bounces until they are spent: radiosity of either wall at the places, from even direct irradiance.
  void solve(double direct_lit, double direct_dark, double albedo) {
    direct_ = {direct_lit, direct_dark};
    albedo_ = albedo;
    std::vector<double> lit(places_.size(), albedo * direct_lit);
    std::vector<double> dark(places_.size(), albedo * direct_dark);
    for (int round = 0; round < 200; ++round) {
      std::vector<double> next_lit;
      std::vector<double> next_dark;
      for (const double place : places_) {
        next_lit.push_back(albedo * (direct_lit + seen_from(place, dark)));
        next_dark.push_back(albedo * (direct_dark + seen_from(place, lit)));
      }
      lit = next_lit;
      dark = next_dark;
    }
    radiosity_ = {lit, dark};
  }

  double irradiance(bool is_lit, double place) const {
    return direct_[is_lit ? 0 : 1] + seen_from(place, radiosity_[is_lit ? 1 : 0]);
  }

 private:
  double seen_from(double x, const std::vector<double>& radiosity) const {
    const double sine = std::sin(opening_);
    double sum = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double t = places_[i];
      const double squared = x * x + t * t - 2 * x * t * std::cos(opening_);
      sum += weights_[i] * radiosity[i] * sine * sine * x * t / (2 * squared * std::sqrt(squared));
    }
    return sum;
  }

  double opening_;
  double albedo_ = 0;
  std::vector<double> places_, weights_;
  std::array<double, 2> direct_{};
  std::array<std::vector<double>, 2> radiosity_;
};

}  // namespace

TEST_CASE("a groove with the sun on one side has the light of its integral equation", "[solve][sun]") {
  const double slope = 1;  // walls of 45 degrees, which meet at a right angle
  const double wall = std::atan(slope);
  const double elevation =
      wall + 2 * pi / 180;  // so high that no wall shades the other, and one is nearly dark
  constexpr double kSnow = 0.9;
  GrooveEquation exact(pi - 2 * wall, 0.5 / std::cos(wall));
  exact.solve(std::sin(elevation + wall), std::sin(elevation - wall), kSnow);

  double coarser = 0;
  for (const int columns : {64, 128}) {
    const Surface surface = make_grooves(columns, slope);
    const TexelVector sun =
        sun_irradiance(surface, {.azimuth_rad = 0, .elevation_rad = elevation, .diameter_rad = 0});
    Request request;
    request.wanted = {.totals = {{.constant = {kSnow}}}, .direct = {sun}};
    request.accuracy = {.visibility = Visibility::exact_slices, .azimuths = 256};
    const Results found = solve(surface, request);
    double squares = 0;
    int count = 0;
    for (int column = 0; column < columns; ++column) {
      const int from_valley = std::abs(column - columns / 2);
      if (from_valley == 0 || from_valley == columns / 2) continue;  // edges have normals of their own
      const double place = 1.0 * from_valley / columns / std::cos(wall);
      // The sun stands toward +x: it lights the wall that falls that way, left of the valley.
      const double error = found.totals[0][0][surface.map.height.index(1, column)] -
                           exact.irradiance(column < columns / 2, place);
      squares += error * error;
      ++count;
    }
    const double rmse = std::sqrt(squares / count);
    INFO(columns << ": " << rmse);
    if (columns == 64) coarser = rmse;
    if (columns == 64) CHECK(rmse < 0.004);  // discretisation: the radiosity bends in the valley
    if (columns == 128) CHECK(rmse < 0.7 * coarser);
  }
}
