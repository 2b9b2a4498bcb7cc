#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "visibility/horizon_sky.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr WalkOptions kWalk{.azimuths = 12, .samples_per_octave = 8, .peak_share = 0.3F};

Surface make_ground(Boundary boundary) {
  return build_surface(make_rough_map(83, 70, boundary, 0.2, 0.05, 11));
}

HorizonSky walk(const Surface& surface, double full_from) {
  return walk_horizon_sky(surface, build_height_pyramid(surface), {.walk = kWalk, .full_from = full_from},
                          {.wanted = {.first = true, .second = true}});
}

/// RMS of 1 − A over each block of 4 × 16 receivers, by rows of blocks.
std::vector<double> block_shares(const Surface& surface, const Map& sky) {
  std::vector<double> shares;
  for (int top = 0; top < surface.height(); top += 4) {
    for (int left = 0; left < surface.width(); left += 16) {
      double squares = 0;
      int present = 0;
      for (int row = top; row < std::min(top + 4, surface.height()); ++row) {
        for (int column = left; column < std::min(left + 16, surface.width()); ++column) {
          if (std::isnan(sky(row, column))) continue;
          squares += (1 - double{sky(row, column)}) * (1 - double{sky(row, column)});
          ++present;
        }
      }
      shares.push_back(present > 0 ? std::sqrt(squares / present) : 0);
    }
  }
  return shares;
}

TEST_CASE("blocks that do not walk keep their sums, and the others get what they always get",
          "[visibility][horizon]") {
  const Surface surface = make_ground(Boundary::tile);
  const DistanceTable maximum_distance = make_distance_table(make_azimuth_table(surface, kWalk, 0.7),
                                                             {.distance = 0.1, .falloff = Falloff::linear});
  const AzimuthTable azimuth = make_azimuth_table(surface, kWalk, 0.7);
  for_tiles(surface, kWalk, [&](const WalkTile& tile) {
    const auto far = std::make_unique<FarView>();
    look_far_scalar(tile, azimuth, *far);
    for (const std::int64_t target : instruction_sets()) {
      const InstructionSet use(target);
      INFO(hwy::TargetName(target));
      const auto is_same = [&](auto&& walk_sums) {
        const auto all = std::make_unique<SkySums>();
        const auto some = std::make_unique<SkySums>();
        for (std::size_t block = 0; block < some->blocks.size(); block += 2) some->blocks.reset(block);
        walk_sums(*all);
        walk_sums(*some);
        for (int i = 0; i < tile.rows; ++i) {
          for (int j = 0; j < tile.columns; ++j) {
            const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
            const bool walks = some->blocks[sky_block(i, j)];
            if (some->sky[at] != (walks ? all->sky[at] : 0)) return false;
            if (some->full[at] != (walks ? all->full[at] : 0)) return false;
          }
        }
        return true;
      };
      CHECK(is_same([&](SkySums& sums) { walk_sky(tile, azimuth, *far, sums); }));
      CHECK(is_same([&](SkySums& sums) { walk_sky_scalar(tile, azimuth, *far, sums); }));
      CHECK(is_same([&](SkySums& sums) { walk_sky_within(tile, azimuth, maximum_distance, sums); }));
      CHECK(is_same([&](SkySums& sums) { walk_sky_within_scalar(tile, azimuth, maximum_distance, sums); }));
    }
  });
}

TEST_CASE("all azimuths are walked from a share of the surface on, and every other one below it",
          "[visibility][horizon]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = make_ground(boundary);
  const HorizonSky every_other = walk(surface, kInfinity);
  const HorizonSky all = walk(surface, 1e-9);
  const std::vector<double> shares = block_shares(surface, every_other.sky_view_factor);
  std::vector<double> sorted = shares;
  std::sort(sorted.begin(), sorted.end());
  const double from = 0.5 * (sorted[sorted.size() / 2 - 1] + sorted[sorted.size() / 2]);
  const HorizonSky mixed = walk(surface, from);
  int full = 0;
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column) {
      const auto block = static_cast<std::size_t>(row / 4 * ((surface.width() + 15) / 16) + column / 16);
      const HorizonSky& expected = shares[block] >= from ? all : every_other;
      full += shares[block] >= from ? 1 : 0;
      const std::size_t texel = surface.map.height.index(row, column);
      if (std::isnan(surface.map.height.values[texel])) continue;
      REQUIRE(mixed.sky_view_factor.values[texel] == expected.sky_view_factor.values[texel]);
      REQUIRE(mixed.ambient_occlusion.values[texel] == expected.ambient_occlusion.values[texel]);
      REQUIRE(mixed.moments.first.values[texel] == expected.moments.first.values[texel]);
      REQUIRE(mixed.moments.second.values[texel] == expected.moments.second.values[texel]);
    }
  }
  CHECK(full > 83 * 70 / 3);
  CHECK(full < 83 * 70 * 2 / 3);
  // All of them are what is walked without a share, but for the order of sums.
  const HorizonSky plain = walk(surface, 0);
  for (std::size_t texel = 0; texel < surface.map.height.size(); ++texel) {
    const double a = all.sky_view_factor.values[texel];
    if (!std::isnan(a)) REQUIRE(a == Approx(plain.sky_view_factor.values[texel]).margin(1e-6));  // rounding
  }
}

TEST_CASE("open ground is open by every other azimuth too", "[visibility][horizon]") {
  const Surface surface = build_surface(make_map(40, 40, Boundary::tile, [](double, double) { return 3.0; }));
  const HorizonSky sky = walk(surface, 0.5);
  for (std::size_t texel = 0; texel < surface.map.height.size(); ++texel) {
    REQUIRE(sky.sky_view_factor.values[texel] == 1);
    REQUIRE(sky.ambient_occlusion.values[texel] == 1);
  }
}

}  // namespace
}  // namespace heightlight
