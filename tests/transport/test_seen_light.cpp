#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/texel_algebra.h"
#include "test_maps.h"
#include "transport/horizon_plan.h"
#include "transport/receiver_blocks.h"
#include "transport/root_mean_square.h"
#include "transport/seen_light.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A map with its sky's shares, 0.15 to 1 on deep bricks.
struct Ground {
  Surface surface;
  HeightMips mips;
  TexelVector sky;

  explicit Ground(Heightmap map)
      : surface(build_surface(std::move(map))),
        mips(build_height_mips(surface)),
        sky(surface.map.height.size()) {
    const HorizonSky walked =
        walk_horizon_sky(surface, mips, {.walk = {.azimuths = 16, .fineness = 8, .peak_share = 0.3F}});
    for (std::size_t i = 0; i < sky.size(); ++i) {
      const float share = walked.sky_view_factor.values[i];
      sky[i] = std::isnan(share) ? 0 : double{share};
    }
  }

  TexelVector gather(const TexelVector& x, const LinkPlan& plan) const {
    SeenLight light(surface, plan, {});
    if (plan.own_share > 0) light.add_own_links(mips, sky, plan, {});
    TexelVector result(sky.size());
    light.gather(x, sky, result);
    return result;
  }
};

LinkPlan plan_of(int lattice_stride, double own_from) {
  return {.walk = {.azimuths = 8, .fineness = 12, .peak_share = 0.3F},
          .lattice_stride = lattice_stride,
          .lattice_walk = {.azimuths = 12, .fineness = 8, .peak_share = 0.3F},
          .own_from = own_from,
          .own_share = own_from == kInfinity ? 0.0 : 1.0};
}

/// Radiosity that no link could like.
TexelVector make_light(const TexelVector& sky) {
  TexelVector x = sky;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += 0.2 * std::sin(0.9 * static_cast<double>(i));
  return x;
}

TEST_CASE("a block's share of the surface is the RMS of its receivers' 1 - A", "[transport][links]") {
  Heightmap map = make_rough_map(37, 5, Boundary::open, 0.1, 0, 1);
  map.height(2, 17) = std::numeric_limits<float>::quiet_NaN();
  for (int column = 32; column < 37; ++column) map.height(4, column) = map.height(2, 17);
  const Surface surface = build_surface(map);
  TexelVector sky(37 * 5, 1);
  for (int column = 16; column < 32; ++column) {
    sky[surface.map.height.index(2, column)] = 1 - 0.1 * (column - 15);
  }
  double squares = 0;
  for (int k = 1; k <= 16; ++k) squares += k == 2 ? 0 : 0.01 * k * k;
  for (const int column : {16, 20, 31}) {
    CHECK(surface_share(surface, sky, 2, column) ==
          Approx(std::sqrt(squares / 15)).epsilon(1e-14));  // rounding
  }
  CHECK(surface_share(surface, sky, 2, 15) == 0);
  CHECK(surface_share(surface, sky, 4, 36) == 0);  // no receiver at all
  const TileFrame tile = TileGrid(37, 5).frame(0);
  CHECK(blocks_above(surface, sky, tile, 0) == all_blocks(tile));
  CHECK(all_blocks(tile).count() == 15);
  CHECK(blocks_above(surface, sky, tile, 1e-3) == BlockSet().set(block_index(2, 16)));
  CHECK(blocks_above(surface, sky, tile, kInfinity).none());
  CHECK(block_share(surface, all_blocks(surface)) == 1);
  CHECK(block_share(surface, blocks_above(surface, sky, 1e-3)) == Approx(1.0 / 15));
}

TEST_CASE("a lattice fits maps without holes whose sides it divides, or which are open",
          "[transport][links]") {
  const auto fits = [](int width, int height, Boundary boundary, double missing, int stride) {
    return ReceiverLattice::fits(build_surface(make_rough_map(width, height, boundary, 0.1, missing, 1)),
                                 stride);
  };
  CHECK(fits(128, 256, Boundary::tile, 0, 2));
  CHECK_FALSE(fits(128, 256, Boundary::tile, 0, 4));
  CHECK_FALSE(fits(129, 256, Boundary::tile, 0, 2));
  CHECK(fits(129, 256, Boundary::open, 0, 2));
  CHECK_FALSE(fits(129, 256, Boundary::open, 0.01, 2));
}

TEST_CASE("what a lattice spreads is linear between its receivers, and wraps or ends with the map",
          "[transport][links]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_rough_map(16, 12, boundary, 0.1, 0, 1));
  const ReceiverLattice lattice(surface, 4);
  Image<float> values(lattice.width, lattice.height);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) values(row, column) = static_cast<float>(10 * row + column);
  }
  Image<float> spread(16, 12);
  spread_lattice(surface, lattice, values, spread);
  const bool tiles = boundary == Boundary::tile;
  CHECK(spread(4, 8) == 12);
  CHECK(spread(5, 10) == 15);
  CHECK(spread(0, 14) == (tiles ? 1.5F : 3));
  CHECK(spread(11, 0) == (tiles ? 5 : 20));
}

TEST_CASE("receivers have links of their own where they see much, and the lattice's elsewhere",
          "[transport][links]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Ground ground(make_synth_map("brick", 128, boundary, 0.2));
  const TexelVector x = make_light(ground.sky);
  const double from = 0.4;
  const TexelVector own = ground.gather(x, plan_of(1, 0));
  const TexelVector lattice = ground.gather(x, plan_of(2, kInfinity));
  const TexelVector mixed = ground.gather(x, plan_of(2, from));
  int own_count = 0;
  for (int row = 0; row < 128; ++row) {
    for (int column = 0; column < 128; ++column) {
      const std::size_t texel = ground.surface.map.height.index(row, column);
      const bool is_own = surface_share(ground.surface, ground.sky, row, column) >= from;
      own_count += is_own ? 1 : 0;
      REQUIRE(mixed[texel] == (is_own ? own : lattice)[texel]);
    }
  }
  CHECK(own_count > 128 * 128 / 10);
  CHECK(own_count < 128 * 128 * 9 / 10);
  // Where little is seen, a lattice errs by little.
  CHECK(rms(as_eigen(mixed) - as_eigen(own)) < 0.5 * rms(as_eigen(lattice) - as_eigen(own)));
  const TexelVector seen = ground.gather(TexelVector(x.size(), 1), plan_of(2, from));
  const auto error = as_eigen(seen).array() - (1 - as_eigen(ground.sky).array());
  CHECK(error.abs().maxCoeff() < 1e-6);  // rounding, single precision
}

TEST_CASE("short of memory, a mixture of links walks again, and tells the same", "[transport][links]") {
  const Ground ground(make_synth_map("brick", 128, Boundary::tile, 0.2));
  const TexelVector x = make_light(ground.sky);
  const LinkPlan plan = plan_of(2, 0.4);
  const TexelVector kept = ground.gather(x, plan);
  for (const std::uint64_t memory : {std::uint64_t{0}, std::uint64_t{1} << 20}) {
    const LinkLimits limits{.memory = memory};
    SeenLight light(ground.surface, plan, limits);
    light.add_own_links(ground.mips, ground.sky, plan, limits);
    CHECK(light.bytes() <= memory);
    CHECK(light.kept_share() < 1);
    TexelVector again(x.size());
    light.gather(x, ground.sky, again);
    CHECK(again == kept);
  }
}

TEST_CASE("a plan gives walls links of their own and spreads the rest from a lattice",
          "[transport][horizon][slow]") {
  const Surface surface = build_surface(make_synth_map("brick", 512, Boundary::tile, 0.1));
  const double error = 0.005;
  const PlannedTransport planned = plan_horizon_transport(surface, {.error = error, .total_only = true}, {});
  CHECK(planned.plan.links.lattice_stride > 1);
  CHECK(planned.plan.links.own_share > 0.2);
  CHECK(planned.plan.links.own_share < 0.8);
  CHECK(planned.plan.links.error < error);
  const TexelVector total = solve_totals(*planned.transport, {0.8}, 0.1 * error).totals[0];
  const HorizonCheck check =
      check_by_exact_walks(surface, planned.transport->direct, {{.total = total, .albedo = 0.8}}, 7)[0];
  INFO("total " << check.total_rmse);
  CHECK(check.total_rmse <
        1.5 * error);  // Monte Carlo: a pilot's RMSE against that of others (test_horizon_plan)
}

}  // namespace
}  // namespace heightlight
