#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "test_maps.h"
#include "visibility/profile_walk.h"

namespace heightlight {
namespace {

struct ProfilePoint {
  double way, rise;
};

/// Every breakpoint of a profile on an open map, found family by family: all columns, all rows, all diagonals
/// that the line crosses. In order of way; the first is the receiver.
std::vector<ProfilePoint> brute_force_profile(const Surface& surface, const ProfileLine& line) {
  const Image<float>& h = surface.map.height;
  std::vector<ProfilePoint> profile{{0, 0}};
  const auto add = [&](double way, auto&& height_at) {
    constexpr double kRounding = 1e-12;  // keeps the breakpoints on the outer lines
    const double u = line.column + way * line.step_u;
    const double v = line.row + way * line.step_v;
    const double right = h.width - 1;
    const double bottom = h.height - 1;
    const bool on_map =
        u >= -kRounding && v >= -kRounding && u <= right + kRounding && v <= bottom + kRounding;
    if (!(way > 0) || !std::isfinite(way) || !on_map) return;
    profile.push_back({way, height_at(std::clamp(u, 0.0, right), std::clamp(v, 0.0, bottom)) - line.height});
  };
  const auto between = [](double from, double to, double share) { return from + share * (to - from); };
  for (int j = 0; j < h.width; ++j) {
    add((j - line.column) / line.step_u, [&](double, double v) {
      const int i = std::min(static_cast<int>(v), h.height - 2);
      return between(h(i, j), h(i + 1, j), v - i);
    });
  }
  for (int i = 0; i < h.height; ++i) {
    add((i - line.row) / line.step_v, [&](double u, double) {
      const int j = std::min(static_cast<int>(u), h.width - 2);
      return between(h(i, j), h(i, j + 1), u - j);
    });
  }
  for (int k = -h.height; k <= h.width; ++k) {
    add((k - (line.column - line.row)) / (line.step_u - line.step_v), [&](double u, double v) {
      const int j = std::min(static_cast<int>(u), h.width - 2);
      const int i = std::clamp(j - k, 0, h.height - 2);
      return between(h(i, j), h(i + 1, j + 1), v - i);
    });
  }
  std::sort(profile.begin(), profile.end(),
            [](const ProfilePoint& a, const ProfilePoint& b) { return a.way < b.way; });
  return profile;
}

/// Way at which a ray of some slope first meets the profile; 0 where its first segment rises above the ray.
double first_crossing(const std::vector<ProfilePoint>& profile, double slope) {
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const double before = profile[i - 1].rise - slope * profile[i - 1].way;
    const double after = profile[i].rise - slope * profile[i].way;
    if (after <= 0) continue;
    const double share = i == 1 ? 0 : before / (before - after);
    return profile[i - 1].way + share * (profile[i].way - profile[i - 1].way);
  }
  return std::numeric_limits<double>::infinity();
}

TEST_CASE("the walk finds the horizon and the visible stretches that all breakpoints together give",
          "[visibility][exact]") {
  constexpr int kAzimuths = 20;  // none along an axis
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  const double relief = GENERATE(0.05, 0.5, 100.0);
  Heightmap map = make_rough_map(27, 22, Boundary::open, relief, 0, 8);
  map.spacing.y *= 1.3;
  const Surface surface = build_surface(std::move(map));
  const MaximumPyramid pyramid = build_maximum_pyramid(surface);
  const RayGrid grid = make_ray_grid(surface, pyramid);
  int stretches_seen = 0;
  for (int azimuth = 0; azimuth < kAzimuths; ++azimuth) {
    for (int texel = 0; texel < 27 * 22; texel += 5) {
      const double angle = 2 * std::numbers::pi * (azimuth + 0.25) / kAzimuths;
      ProfileLine line;
      line.row = texel / 27;
      line.column = texel % 27;
      line.height = double{surface.map.height(line.row, line.column)};
      line.step_u = std::cos(angle) / surface.map.spacing.x;
      line.step_v = -std::sin(angle) / surface.map.spacing.y;
      const std::vector<ProfilePoint> profile = brute_force_profile(surface, line);
      double steepest = kNone;
      for (std::size_t i = 1; i < profile.size(); ++i) {
        steepest = std::max(steepest, profile[i].rise / profile[i].way);
      }
      std::vector<VisibleStretch> stretches;
      const double horizon = walk_profile(grid, line, kNone, stretches);
      if (profile.size() == 1) {
        CHECK(horizon == kNone);
        continue;
      }
      REQUIRE(horizon == Approx(steepest).epsilon(1e-12));
      REQUIRE(stretches.back().slope == horizon);
      for (std::size_t i = 1; i < stretches.size(); ++i) {
        const VisibleStretch& stretch = stretches[i];
        const double from = stretches[i - 1].slope;
        if (stretch.slope - from < 1e-9 * relief) continue;  // too narrow for a ray of our own to aim at
        const double crossing = first_crossing(profile, 0.5 * (from + stretch.slope));
        REQUIRE(crossing >= stretch.begin_way - 1e-9);
        REQUIRE(crossing <= stretch.end_way + 1e-9);
        REQUIRE(stretch.begin.cell == stretch.end.cell);
        const double u = stretch.end.cell % 27 + double{stretch.end.across};
        REQUIRE(u == Approx(line.column + stretch.end_way * line.step_u).margin(1e-5));
        ++stretches_seen;
      }
    }
  }
  CHECK(stretches_seen > 1000);
}

TEST_CASE("stretches below the least slope are left out, and the first is cut there", "[visibility][exact]") {
  Heightmap map = make_map(16, 2, Boundary::open, [](int, int column) { return column * column; });
  map.spacing = {1, 1};
  const Surface surface = build_surface(std::move(map));
  const MaximumPyramid pyramid = build_maximum_pyramid(surface);
  const RayGrid grid = make_ray_grid(surface, pyramid);
  ProfileLine line;
  line.step_u = 1;
  std::vector<VisibleStretch> stretches;
  CHECK(walk_profile(grid, line, 3.5, stretches) == 15);
  // h = s² at whole s: from 3 to 4 the slope h/s = 7 − 12/s passes 3.5 at s = 24/7.
  REQUIRE(stretches.size() == 12);
  CHECK(stretches.front().slope == 4);
  CHECK(stretches.front().begin_way == Approx(24.0 / 7).epsilon(1e-14));
  CHECK(stretches.front().end_way == 4);
  stretches.clear();
  CHECK(walk_profile(grid, line, 15, stretches) == 15);
  CHECK(stretches.empty());
}

}  // namespace
}  // namespace heightlight
