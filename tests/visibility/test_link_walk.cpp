#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "transport/link_replay.h"
#include "visibility/link_walk.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

using Stream = std::vector<std::uint8_t>;
using Azimuths = std::vector<LinkAzimuth>;
using WalkLinks = void (*)(const WalkTile&, const Azimuths&, const BlockSet&, Stream&);
using Replay = void (*)(const TileFrame&, const Azimuths&, const BlockSet&, const std::uint8_t*,
                        const LightMips&, float*);

Stream stream_of(WalkLinks walk, const WalkTile& tile, const Azimuths& azimuths) {
  Stream stream;
  walk(tile, azimuths, all_blocks(tile), stream);
  return stream;
}

std::vector<float> means_of(Replay replay, const TileFrame& tile, const Azimuths& azimuths,
                            const Stream& stream, const LightMips& light) {
  std::vector<float> mean(WalkTile::kTexels);
  replay(tile, azimuths, all_blocks(tile), stream.data(), light, mean.data());
  return mean;
}

/// Calls visit(first, azimuth, near, entry) for each entry of a tile's stream, a pointer to a byte: `first`
/// is the block's first receiver, an index into the tile's arrays; `near` tells whether the entry counts as
/// near.
template <class Bytes, class Visit>
void for_entries(const TileFrame& tile, const Azimuths& azimuths, Bytes& stream, Visit&& visit) {
  auto* at = stream.data();
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += kBlock) {
      const auto first = static_cast<std::size_t>(row * WalkTile::kSide + column);
      for (const LinkAzimuth& azimuth : azimuths) {
        const int near = at[0];
        const int all = near + at[1];
        at += 2;
        for (int i = 0; i < all; ++i, at += kEntryBytes) visit(first, azimuth, i < near, at);
      }
    }
  }
  REQUIRE(at == stream.data() + stream.size());
}

/// Steps of weight per receiver, kSide per row.
std::vector<int> count_steps(const TileFrame& tile, const Azimuths& azimuths, const Stream& stream) {
  std::vector<int> steps(WalkTile::kTexels, 0);
  for_entries(tile, azimuths, stream,
              [&](std::size_t first, const LinkAzimuth&, bool, const std::uint8_t* entry) {
                for (std::size_t lane = 0; lane < kBlock; ++lane) steps[first + lane] += entry[1 + lane];
              });
  return steps;
}

template <class Visit>
void for_receivers(const WalkTile& tile, Visit&& visit) {
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; ++column) {
      const auto at = static_cast<std::size_t>(row * WalkTile::kSide + column);
      if (tile.present[at]) visit(at);
    }
  }
}

/// Of order 1, with a period of the map's size, and a little noise: nothing that links could like.
TexelVector make_field(const Surface& surface) {
  TexelVector x(surface.map.height.size());
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column) {
      const double u = 2 * std::numbers::pi * column / surface.width();
      const double v = 2 * std::numbers::pi * row / surface.height();
      const std::size_t texel = surface.map.height.index(row, column);
      x[texel] =
          0.5 + 0.25 * std::sin(2 * u + v) + 0.2 * std::cos(3 * v - u) + 0.1 * unit_real(scramble(texel));
    }
  }
  return x;
}

struct Ground {
  const char* name;
  Heightmap map;
};

Ground ground(int which) {
  switch (which) {
    case 0:
      return {"smooth", make_smooth_map(67, 41, Boundary::tile, 0.2)};
    case 1:
      return {"smooth, tall", make_smooth_map(67, 41, Boundary::open, 10)};
    case 2:
      return {"rough", make_rough_map(80, 64, Boundary::tile, 0.1, 0, 3)};
    case 3:
      return {"rough, tall, holes", make_rough_map(61, 37, Boundary::open, 10, 0.3, 3)};
    case 4:
      return {"rough, holes", make_rough_map(61, 37, Boundary::tile, 0.1, 0.3, 3)};
    case 5:
      return {"brick", make_synth_map("brick", 64, Boundary::tile, 0.1)};
    case 6:
      return {"a texel", make_rough_map(1, 1, Boundary::tile, 0.1, 0, 1)};
    case 7:
      return {"a row", make_rough_map(21, 1, Boundary::tile, 0.1, 0, 1)};
    case 8:
      return {"a column", make_rough_map(1, 21, Boundary::open, 0.1, 0, 1)};
    default:
      return {"tiny", make_rough_map(5, 3, Boundary::tile, 0.3, 0, 1)};
  }
}

TEST_CASE("blocks that are not asked for have no links, and the others the same as ever",
          "[visibility][links]") {
  const auto [name, map] = ground(GENERATE(0, 3, 5, 7));
  const Surface surface = build_surface(map);
  const WalkOptions options{.azimuths = 8, .fineness = 8, .peak_share = 0.3F};
  INFO(name);
  const Azimuths azimuths = make_link_azimuths(surface, options);
  LightMips light(surface);
  light.fill(make_field(surface));
  for_tiles(surface, options, [&](const WalkTile& tile) {
    BlockSet wanted;
    for (std::size_t i = 0; i < wanted.size(); i += 3) wanted.set(i);
    wanted &= all_blocks(tile);
    for (const WalkLinks walk : {walk_links_scalar, walk_links}) {
      const std::vector<float> all =
          means_of(replay_links, tile, azimuths, stream_of(walk, tile, azimuths), light);
      Stream stream;
      walk(tile, azimuths, wanted, stream);
      for (const Replay replay : {replay_links_scalar, replay_links}) {
        std::vector<float> some(WalkTile::kTexels, -7);
        replay(tile, azimuths, wanted, stream.data(), light, some.data());
        for_receivers(tile, [&](std::size_t at) {
          const bool is_wanted = wanted[block_index(static_cast<int>(at) / WalkTile::kSide,
                                                    static_cast<int>(at) % WalkTile::kSide)];
          // rounding of fused products between the replays (as in the test below)
          REQUIRE(some[at] == (is_wanted ? Approx(all[at]).margin(2e-6) : Approx(-7)));
        });
      }
    }
  });
}

TEST_CASE("the link walk's lanes and its scalar twin tell the same light on every instruction set",
          "[visibility][links]") {
  const auto [name, map] = ground(GENERATE(range(0, 10)));
  const int fineness = GENERATE(8, 32);
  const Surface surface = build_surface(map);
  const WalkOptions options{.azimuths = 8, .fineness = fineness, .peak_share = 0.3F};
  INFO(name << ", fineness " << fineness);
  const Azimuths azimuths = make_link_azimuths(surface, options);
  LightMips light(surface);
  light.fill(make_field(surface));
  for_tiles(surface, options, [&](const WalkTile& tile) {
    const Stream twin = stream_of(walk_links_scalar, tile, azimuths);
    const std::vector<int> twin_steps = count_steps(tile, azimuths, twin);
    const std::vector<float> twin_means = means_of(replay_links_scalar, tile, azimuths, twin, light);
    for (const std::int64_t target : instruction_sets()) {
      const InstructionSet use(target);
      INFO(hwy::TargetName(target));
      const Stream lanes = stream_of(walk_links, tile, azimuths);
      const std::vector<int> steps = count_steps(tile, azimuths, lanes);
      const std::vector<float> means = means_of(replay_links_scalar, tile, azimuths, lanes, light);
      const std::vector<float> fast_means = means_of(replay_links, tile, azimuths, lanes, light);
      int other_steps = 0;
      double other_light = 0;
      double other_replay = 0;
      for_receivers(tile, [&](std::size_t at) {
        other_steps = std::max(other_steps, std::abs(steps[at] - twin_steps[at]));
        // What is gathered, (1 − A) × the mean: a step more or less weighs much in a mean of few.
        const double share = twin_steps[at] / (double{kQuantum} * options.azimuths);
        other_light = std::max(other_light, share * std::fabs(double{means[at]} - double{twin_means[at]}));
        other_replay = std::max(other_replay, std::fabs(double{fast_means[at]} - double{means[at]}));
      });
      CHECK(other_steps <= 1);  // rounding of the carry that is left at the end
      // rounding: where a weight lies between two steps, one falls to an entry's neighbour, 1/(kQuantum K) =
      // 1.6e-3 of the field's differences there, which are up to a third; twice in a receiver's few hundred
      CHECK(other_light < 2 * 1.6e-3 / 3);
      CHECK(other_replay < 1e-6);  // rounding of sums (measured: 2.4e-7)
    }
  });
}

TEST_CASE("steps of links sum to what the sky's walk leaves of the hemisphere, to a step per azimuth",
          "[visibility][links]") {
  const auto [name, map] = ground(GENERATE(range(0, 10)));
  // So fine that all but the farthest things are looked at by each receiver, as links are walked; so many
  // azimuths that Σ S(m₀) = K to exp(−K asinh(1/kSteep)) = 10⁻⁵ where the sky's walk takes it to be K.
  const WalkOptions options{.azimuths = 24, .fineness = 32, .peak_share = 0.3F};
  const Surface surface = build_surface(map);
  INFO(name);
  const Azimuths azimuths = make_link_azimuths(surface, options);
  for_tiles(surface, options, [&](const WalkTile& tile) {
    const std::vector<int> steps = count_steps(tile, azimuths, stream_of(walk_links, tile, azimuths));
    SkySums sums;
    FarView far;
    for (const LinkAzimuth& azimuth : azimuths) {
      look_far(tile, azimuth.walk, far);
      walk_sky(tile, azimuth.walk, far, sums);
    }
    double worst = 0;
    for_receivers(tile, [&](std::size_t at) {
      const double expected = double{kQuantum} * double{sums.full[at] - sums.sky[at]};
      worst = std::max(worst, std::fabs(expected - steps[at]));
    });
    INFO(worst << " steps apart");
    // A step per azimuth: a last rise of less than kLeastRise goes unseen, kQuantum kLeastRise |S'| steps
    // with |S'| ≤ 0.65 over level ground; and links see what the shared far view misses (measured: 0.45 per
    // azimuth).
    CHECK(worst < options.azimuths);
  });
}

TEST_CASE("entries name light nodes that exist, in rising order, near ones first", "[visibility][links]") {
  const auto [name, map] = ground(GENERATE(range(0, 10)));
  const int fineness = GENERATE(8, 16, 32);
  const Surface surface = build_surface(map);
  const WalkOptions options{.azimuths = 6, .fineness = fineness, .peak_share = 0.3F};
  const Azimuths azimuths = make_link_azimuths(surface, options);
  const LightMips light(surface);
  INFO(name << ", fineness " << fineness);
  for (const LinkAzimuth& azimuth : azimuths) {
    const std::vector<LightNode>& nodes = azimuth.light.nodes;
    REQUIRE(nodes.size() <= 256);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const LightNode& node = nodes[i];
      REQUIRE((node.level == 0) == (static_cast<int>(i) < azimuth.light.near_nodes));
      // What replaying reads, from any receiver of any block, lies inside a level's margins.
      const int most_rows = (surface.height() - 1 + std::abs(node.row[0])) >> node.level;
      REQUIRE(most_rows < light.level(node.level).height + LightLevel::kRowMargin);
      REQUIRE((-std::abs(node.row[0]) >> node.level) >= -LightLevel::kRowMargin);
      REQUIRE((-std::abs(node.column[0]) >> node.level) >= -LightLevel::kMargin);
      const int most_columns = (surface.width() - 1 + kBlock + std::abs(node.column[0])) >> node.level;
      REQUIRE(most_columns + kShared < light.level(node.level).width + LightLevel::kMargin);
      REQUIRE(node.share >= 0);
      REQUIRE(node.share <= 1);
    }
    for (const NodeShare& share : azimuth.light.near)
      REQUIRE(share.node + share.splits < static_cast<int>(nodes.size()));
    for (const std::vector<NodeShare>& ring : azimuth.light.rings) {
      for (const NodeShare& share : ring) REQUIRE(share.node < nodes.size());
    }
  }
  for_tiles(surface, options, [&](const WalkTile& tile) {
    const Stream stream = stream_of(walk_links, tile, azimuths);
    const LinkAzimuth* last_azimuth = nullptr;
    std::size_t last_first = 0;
    int last_node = -1;
    for_entries(tile, azimuths, stream,
                [&](std::size_t first, const LinkAzimuth& azimuth, bool near, const std::uint8_t* entry) {
                  const int node = entry[0];
                  if (last_azimuth != &azimuth || last_first != first) last_node = -1;
                  REQUIRE(node > last_node);
                  REQUIRE(node < static_cast<int>(azimuth.light.nodes.size()));
                  REQUIRE(near == (node < azimuth.light.near_nodes));
                  REQUIRE(std::any_of(entry + 1, entry + kEntryBytes, [](int steps) { return steps > 0; }));
                  last_azimuth = &azimuth;
                  last_first = first;
                  last_node = node;
                });
  });
}

TEST_CASE("what a block holds for receivers outside the map does not matter", "[visibility][links]") {
  const auto [width, height] = GENERATE(std::pair{5, 7}, std::pair{71, 3}, std::pair{1, 1});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, 0.2, 0, 7));
  const WalkOptions options{.azimuths = 8, .fineness = 8, .peak_share = 0.3F};
  const Azimuths azimuths = make_link_azimuths(surface, options);
  LightMips light(surface);
  light.fill(make_field(surface));
  for_tiles(surface, options, [&](const WalkTile& tile) {
    Stream stream = stream_of(walk_links, tile, azimuths);
    const std::vector<float> before = means_of(replay_links, tile, azimuths, stream, light);
    for_entries(tile, azimuths, stream,
                [&](std::size_t first, const LinkAzimuth&, bool, std::uint8_t* entry) {
                  const int column = static_cast<int>(first) % WalkTile::kSide;
                  for (int lane = std::max(0, tile.columns - column); lane < kBlock; ++lane)
                    entry[1 + lane] = 255;
                });
    const std::vector<float> after = means_of(replay_links, tile, azimuths, stream, light);
    const std::vector<float> twin = means_of(replay_links_scalar, tile, azimuths, stream, light);
    for_receivers(tile, [&](std::size_t at) {
      REQUIRE(after[at] == before[at]);
      REQUIRE(twin[at] == Approx(before[at]).margin(1e-6));
    });
  });
}

TEST_CASE("a flat map has no links, and its receivers keep their own light", "[visibility][links]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_map(70, 20, boundary, [](int, int) { return 0.4; }));
  const WalkOptions options{.azimuths = 8, .fineness = 8, .peak_share = 0.3F};
  const Azimuths azimuths = make_link_azimuths(surface, options);
  LightMips light(surface);
  const TexelVector field = make_field(surface);
  light.fill(field);
  for_tiles(surface, options, [&](const WalkTile& tile) {
    const Stream stream = stream_of(walk_links, tile, azimuths);
    for_entries(tile, azimuths, stream,
                [](std::size_t, const LinkAzimuth&, bool, const std::uint8_t*) { FAIL("a link"); });
    const std::vector<float> means = means_of(replay_links, tile, azimuths, stream, light);
    for_receivers(tile, [&](std::size_t at) {
      const int row = tile.first_row + static_cast<int>(at) / WalkTile::kSide;
      const int column = tile.first_column + static_cast<int>(at) % WalkTile::kSide;
      REQUIRE(means[at] == static_cast<float>(field[surface.map.height.index(row, column)]));
    });
  });
}

}  // namespace
}  // namespace heightlight
