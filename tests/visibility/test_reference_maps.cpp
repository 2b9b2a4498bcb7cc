#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "heightlight/files.h"
#include "heightlight/solve.h"
#include "shared_data.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"

// Maps of horizons that other programs computed from real terrain (data/reference), all of them by sampling
// the nearest texel. Each test says what its reference turned out to be, found by trying until it was
// reproduced.

namespace heightlight {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = 180 / kPi;

std::optional<Heightmap> load_terrain(const std::string& name, double texel) {
  const auto path = find_shared_data(name);
  if (!path) return std::nullopt;
  LoadOptions options;
  options.texel = Spacing{texel, texel};
  options.boundary = Boundary::open;
  return load_heightmap(*path, options, std::uint64_t{1} << 30).map;
}

/// The values of a float file as they are.
std::optional<Map> read_reference(const std::string& name) {
  std::optional<Heightmap> values = load_terrain("reference/" + name, 1);
  if (!values) return std::nullopt;
  for (float& value : values->height.values) value = static_cast<float>(value + values->base);
  return std::move(values->height);
}

/// Steps of one texel along an azimuth until the map ends: the nearest texel's slope, over the length of the
/// steps or over the texel's own distance. 0 at least.
enum class SampledWay { steps, texel };

double sampled_slope(const Surface& surface, int row, int column, double azimuth, SampledWay way,
                     double step = 1, double maximum_distance = 1e9) {
  const Image<float>& h = surface.map.height;
  double steepest = 0;
  for (int k = 1;; ++k) {
    const int right = static_cast<int>(std::lround(k * step * std::cos(azimuth)));
    const int up = static_cast<int>(std::lround(k * step * std::sin(azimuth)));
    const int i = row - up;
    const int j = column + right;
    if (i < 0 || j < 0 || i >= h.height || j >= h.width) return steepest;
    const double distance = way == SampledWay::steps ? k * step : std::hypot(right, up);
    if (distance >= maximum_distance) return steepest;
    const double rise = double{h(i, j)} - double{h(row, column)};
    steepest = std::max(steepest, rise / (distance * surface.map.spacing.x));
  }
}

struct Difference {
  double mean_absolute = 0;
  double close = 0;  ///< share of texels within 10⁻⁴
};

/// Of value(row, column) against a reference, over every `stride`-th texel no nearer than `margin` to the
/// edge.
template <class Value>
Difference compare(const Map& reference, int margin, int stride, Value&& value) {
  const int rows = (reference.height - 2 * margin) / stride;
  const int columns = (reference.width - 2 * margin) / stride;
  std::vector<Difference> sums(static_cast<std::size_t>(rows));
  parallel_for(rows, [&](std::int64_t r) {
    Difference& sum = sums[static_cast<std::size_t>(r)];
    for (int c = 0; c < columns; ++c) {
      const int row = margin + static_cast<int>(r) * stride;
      const int column = margin + c * stride;
      const double difference = std::fabs(value(row, column) - double{reference(row, column)});
      sum.mean_absolute += difference / rows / columns;
      if (difference < 1e-4) sum.close += 1.0 / rows / columns;
    }
  });
  Difference total;
  for (const Difference& sum : sums) {
    total.mean_absolute += sum.mean_absolute;
    total.close += sum.close;
  }
  return total;
}

// Horizons toward the four sides, in degrees, not below 0, stored as 16 bits of sin h, found on heights
// rounded to whole metres: half a metre up or down at either end is 0.6° for a horizon one texel away. On
// heights so rounded theirs are higher than ours nowhere to speak of; where they are lower they missed the
// horizon, in one texel of eight by more than a degree.
TEST_CASE("horizons of the lakes match topocalc's where those are complete", "[visibility][exact][shared]") {
  const auto [side, azimuth] = GENERATE(
      table<std::string, double>({{"east", 0}, {"north", kPi / 2}, {"west", kPi}, {"south", 3 * kPi / 2}}));
  const auto lakes = load_terrain("terrain/lakes_dem.tif", 50);
  const auto reference = read_reference("lakes_horizon_" + side + "_deg.tif");
  if (!lakes || !reference) return;
  const Surface surface = build_surface(*lakes);
  const ExactWalker walker(surface, 1);
  Heightmap rounded = *lakes;
  for (float& h : rounded.height.values) h = static_cast<float>(std::round(h + rounded.base) - rounded.base);
  const Surface rounded_surface = build_surface(std::move(rounded));
  const ExactWalker rounded_walker(rounded_surface, 1);
  constexpr int kMargin = 6;  // more than five texels from the edge
  std::vector<double> difference;
  int missed = 0;
  int higher_when_rounded = 0;
  for (int row = kMargin; row < surface.height() - kMargin; ++row) {
    for (int column = kMargin; column < surface.width() - kMargin; ++column) {
      const double ours = walker.horizon_rad(row, column, azimuth);
      const double on_rounded = rounded_walker.horizon_rad(row, column, azimuth);
      const double theirs = (*reference)(row, column);
      difference.push_back(std::max(0.0, ours) * kDegrees - theirs);
      if (std::max(0.0, on_rounded) * kDegrees < theirs - 0.02) ++higher_when_rounded;
      if (difference.back() <= 1) continue;
      // Here they missed it: along a row or a column the profile's breakpoints are the samples themselves.
      ++missed;
      const double from_samples = std::atan(sampled_slope(surface, row, column, azimuth, SampledWay::steps));
      REQUIRE(ours == Approx(from_samples).margin(1e-14));
    }
  }
  CAPTURE(side);
  const auto count = static_cast<double>(difference.size());
  CHECK(missed / count < 0.15);
  CHECK(higher_when_rounded / count < 1e-3);
  CHECK(*std::min_element(difference.begin(), difference.end()) > -0.6);
  for (double& value : difference) value = std::fabs(value);
  const auto middle = difference.begin() + static_cast<std::ptrdiff_t>(difference.size() / 2);
  std::nth_element(difference.begin(), middle, difference.end());
  CHECK(*middle <= 0.1);
  const auto within = std::count_if(difference.begin(), difference.end(), [](double d) { return d <= 1; });
  CHECK(static_cast<double>(within) / count >= 0.85);
}

TEST_CASE("the lakes' horizons by the compass are topocalc's, side by side",
          "[visibility][shared][terrain]") {
  const auto lakes = load_terrain("terrain/lakes_dem.tif", 50);
  if (!lakes) return;
  const Surface surface = build_surface(*lakes);
  Request request;
  request.wanted.horizon_rad = equal_azimuths(4, AzimuthConvention::north);
  request.accuracy.error = 0.0005;
  const Results results = solve(surface, request);
  const std::vector<std::string> sides{"north", "east", "south", "west"};
  for (std::size_t ours = 0; ours < sides.size(); ++ours) {
    for (std::size_t theirs = 0; theirs < sides.size(); ++theirs) {
      const auto reference = read_reference("lakes_horizon_" + sides[theirs] + "_deg.tif");
      if (!reference) return;
      std::vector<double> difference;
      for (std::size_t i = 0; i < reference->size(); ++i) {
        const double degrees = std::max(0.0, double{results.horizons[ours].values[i]}) * kDegrees;
        difference.push_back(std::fabs(degrees - double{reference->values[i]}));
      }
      const auto middle = difference.begin() + static_cast<std::ptrdiff_t>(difference.size() / 2);
      std::nth_element(difference.begin(), middle, difference.end());
      INFO("toward " << sides[ours] << ", theirs toward " << sides[theirs]);
      if (ours == theirs) CHECK(*middle < 0.2);  // discretisation: blocks; theirs counts whole metres
      if (ours != theirs) CHECK(*middle > 1);
    }
  }
}

/// Cosine-weighted sky view factor of a tilted surface from horizons in the azimuths 2π k/K, without clamping
/// them to the tangent plane: (1/π) Σ (2π/K) ∫_h^{π/2} (n·ω) cosθ dθ. Where a horizon is below the tangent
/// plane it takes the negative cosines in between along.
template <class Horizon>
double tilted_sky_view_factor(const Vector3& normal, int azimuths, Horizon&& horizon_rad) {
  double sum = 0;
  for (int k = 0; k < azimuths; ++k) {
    const double azimuth = 2 * kPi * k / azimuths;
    const double h = std::max(0.0, horizon_rad(azimuth));
    const double along = double{normal.x} * std::cos(azimuth) + double{normal.y} * std::sin(azimuth);
    const double up = std::cos(h) * std::cos(h);
    sum += along * (kPi / 2 - h - std::sin(h) * std::cos(h)) + double{normal.z} * up;
  }
  return sum / azimuths;
}

// SAGA's sky view factor: 16 azimuths k · 22.5°, the nearest texel after each step of one texel, its height
// over the length of the steps (not over its own distance). Rebuilt so, 95 % of the texels agree to 10⁻⁴.
TEST_CASE("the lakes' sky view factor on the tilted surface matches SAGA's", "[visibility][exact][shared]") {
  const auto lakes = load_terrain("terrain/lakes_dem.tif", 50);
  const auto reference = read_reference("lakes_svf_saga_tilted.tif");
  if (!lakes || !reference) return;
  const Surface surface = build_surface(*lakes);
  const ExactWalker walker(surface, 1);
  const Difference rebuilt = compare(*reference, 6, 2, [&](int row, int column) {
    return tilted_sky_view_factor(surface.normal(row, column), 16, [&](double azimuth) {
      return std::atan(sampled_slope(surface, row, column, azimuth, SampledWay::steps));
    });
  });
  CHECK(rebuilt.close > 0.9);
  const Difference exact = compare(*reference, 6, 1, [&](int row, int column) {
    return tilted_sky_view_factor(surface.normal(row, column), 16,
                                  [&](double azimuth) { return walker.horizon_rad(row, column, azimuth); });
  });
  CHECK(exact.mean_absolute <= 0.004);  // measured: 0.0028, what that sampling costs
  Request request;
  request.wanted = {.sky = true, .below = BelowHorizontal::ground};
  request.accuracy.error = 0.001;
  const Results walked = solve(surface, request);
  // Ours is limited by the tangent plane, theirs is not, so that it is less where a horizon lies below that.
  const Difference ours = compare(
      *reference, 6, 1, [&](int row, int column) { return double{walked.sky_view_factor(row, column)}; });
  CHECK(ours.mean_absolute <= 0.006);
  request.wanted.below = BelowHorizontal::sky;
  const Results open = solve(surface, request);
  const Difference with_sky = compare(
      *reference, 6, 1, [&](int row, int column) { return double{open.sky_view_factor(row, column)}; });
  CHECK(with_sky.mean_absolute > 2 * ours.mean_absolute);
}

// Mean cos h over 16 azimuths k · 22.5°, horizons not below 0: along each azimuth one texel per step of the
// larger coordinate, nearest to the line, over its own distance, and only those nearer than 51 texels.
// Rebuilt so, all texels agree to 10⁻⁴. (Beyond the map its outer samples are repeated; texels that see them
// are left out.)
TEST_CASE("Toulouse's mean cosine of horizons within 50 texels matches rastertools'",
          "[visibility][exact][shared][slow]") {
  constexpr int kAzimuths = 16;
  constexpr int kReach = 51;
  const auto toulouse = load_terrain("terrain/toulouse-mnh.tif", 0.5);
  const auto reference = read_reference("toulouse_mean_cos_h_16az_50px.tif");
  if (!toulouse || !reference) return;
  const Surface surface = build_surface(*toulouse);
  const ExactWalker walker(surface, 1, kReach * 0.5);
  const auto mean_cosine = [](auto&& horizon_rad, double turn = 0) {
    double sum = 0;
    for (int k = 0; k < kAzimuths; ++k)
      sum += std::cos(std::max(0.0, horizon_rad(2 * kPi * (k + turn) / kAzimuths)));
    return sum / kAzimuths;
  };
  const Difference rebuilt = compare(*reference, kReach, 7, [&](int row, int column) {
    return mean_cosine([&](double azimuth) {
      const double step = 1 / std::max(std::fabs(std::cos(azimuth)), std::fabs(std::sin(azimuth)));
      return std::atan(sampled_slope(surface, row, column, azimuth, SampledWay::texel, step, kReach));
    });
  });
  CHECK(rebuilt.close == Approx(1));
  const Difference exact = compare(*reference, kReach, 3, [&](int row, int column) {
    return mean_cosine([&](double azimuth) { return walker.horizon_rad(row, column, azimuth); });
  });
  CHECK(exact.mean_absolute <= 0.004);  // measured: 0.0037, what nearest texels cost among walls
  Request request;
  request.wanted.definitions = {SkyDefinition::mean_cos_h};
  request.wanted.maximum_distance = MaximumDistance{.distance = kReach * 0.5};
  request.accuracy.error = 0.001;
  request.accuracy.azimuths = kAzimuths;
  const Results walked = solve(surface, request);
  const Difference ours = compare(
      *reference, kReach, 3, [&](int row, int column) { return double{walked.definitions[0](row, column)}; });
  // Ours count from a quarter of a step: among walls that many azimuths differ by as much as they are turned.
  const Difference turned = compare(*reference, kReach, 3, [&](int row, int column) {
    return mean_cosine([&](double azimuth) { return walker.horizon_rad(row, column, azimuth); }, 0.25);
  });
  CHECK(ours.mean_absolute <= turned.mean_absolute + 0.001);  // discretisation: what is asked for
}

}  // namespace
}  // namespace heightlight
