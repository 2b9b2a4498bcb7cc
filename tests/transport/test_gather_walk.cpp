#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "test_maps.h"
#include "transport/exact_gather.h"
#include "transport/gather_walk.h"
#include "transport/gathered_tiles.h"
#include "transport/map_gather.h"
#include "visibility/exact_walk.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

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
      return {"cobbles", make_synth_map("cobbles", 70, Boundary::open, 0.4)};
    case 7:
      return {"a texel", make_rough_map(1, 1, Boundary::tile, 0.1, 0, 1)};
    case 8:
      return {"a row", make_rough_map(21, 1, Boundary::tile, 0.1, 0, 1)};
    case 9:
      return {"a column", make_rough_map(1, 21, Boundary::open, 0.1, 0, 1)};
    default:
      return {"tiny", make_rough_map(5, 3, Boundary::tile, 0.3, 0, 1)};
  }
}
constexpr int kGrounds = 11;

/// NaN where samples are missing.
template <class Value>
Map make_field(const Surface& surface, Value&& value) {
  Map field(surface.width(), surface.height());
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column) {
      const bool missing = std::isnan(surface.map.height(row, column));
      field(row, column) =
          missing ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(value(row, column));
    }
  }
  return field;
}

/// Of order 1, with a period of the map's size.
Map smooth_map(const Surface& surface) {
  return make_field(surface, [&](int row, int column) {
    const double u = 2 * std::numbers::pi * column / surface.width();
    const double v = 2 * std::numbers::pi * row / surface.height();
    return 0.5 + 0.25 * std::sin(2 * u + v) + 0.25 * std::cos(3 * v - u);
  });
}

/// As different from texel to texel as a field can be.
Map noisy_field(const Surface& surface, std::uint64_t seed) {
  return make_field(surface, [&](int row, int column) {
    return unit_real(hash_combine(seed, surface.map.height.index(row, column)));
  });
}

template <class Visit>
void for_receivers(const Surface& surface, Visit&& visit) {
  for (std::size_t i = 0; i < surface.map.height.size(); ++i) {
    if (!std::isnan(surface.map.height.values[i])) visit(i);
  }
}

TEST_CASE("the gather's lanes and its one lane see the same light on every instruction set",
          "[transport][gather]") {
  const auto [name, map] = ground(GENERATE(range(0, kGrounds)));
  const int samples_per_octave = GENERATE(8, 32);
  const Surface surface = build_surface(map);
  const WalkOptions options{.azimuths = 12, .samples_per_octave = samples_per_octave, .peak_share = 0.3F};
  const std::vector<Map> fields{noisy_field(surface, 7), smooth_map(surface)};
  const GatheredMap one = gather_with(walk_gather_by_one, surface, options, fields);
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    const GatheredMap lanes = gather_with(walk_gather, surface, options, fields);
    double weight = 0;
    double light = 0;
    double squares = 0;
    for_receivers(surface, [&](std::size_t i) {
      weight = std::max(weight, std::fabs(double{lanes.weight[i]} - double{one.weight[i]}));
      if (!(one.weight[i] > 0 && lanes.weight[i] > 0)) return;
      for (std::size_t f = 0; f < fields.size(); ++f) {
        const double error = one.weight[i] * (lanes.mean(f, i) - one.mean(f, i));
        light = std::max(light, std::fabs(error));
        squares += error * error / static_cast<double>(2 * surface.map.height.size());
      }
    });
    INFO(name << ", fineness " << samples_per_octave << ", " << hwy::TargetName(target) << ": weight "
              << weight << ", light " << light << ", RMS " << std::sqrt(squares));
    // Where no sample can rise by β above what any lane has seen, all of them end. So much of a slope weighs
    // up to 0.65 as much over level ground (measured, in β: 0.25, 0.07 and 0.004).
    CHECK(weight < 0.65 * least_rise(samples_per_octave));
    CHECK(light < 0.15 * least_rise(samples_per_octave));
    CHECK(std::sqrt(squares) < 0.006 * least_rise(samples_per_octave));
  }
}

TEST_CASE("what a gather sees weighs what the sky's walk leaves of the hemisphere", "[transport][gather]") {
  const auto [name, map] = ground(GENERATE(range(0, kGrounds)));
  // So fine that all but the farthest things are looked at by each receiver, as gathers walk; so many
  // azimuths that Σ S(m₀) = K to exp(−K asinh(1/2)) = 10⁻⁵ where the sky's walk takes it to be K.
  const WalkOptions options{.azimuths = 24, .samples_per_octave = 32, .peak_share = 0.3F};
  const Surface surface = build_surface(map);
  const WalkedSky sky = walk_sky_with(look_far, walk_sky, surface, options);
  for (const WalkGather walk : {walk_gather, walk_gather_by_one}) {
    const GatheredMap gathered = gather_with(walk, surface, options, {smooth_map(surface)});
    double worst = 0;
    for_receivers(surface, [&](std::size_t i) {
      const double left = (double{sky.full[i]} - double{sky.sky[i]}) / options.azimuths;
      worst = std::max(worst, std::fabs(double{gathered.weight[i]} - left));
    });
    INFO(name << ": " << worst << " of an azimuth's");
    // a last rise of less than β goes unseen, as above (measured: 6e-3)
    CHECK(worst < 0.65 * least_rise(options.samples_per_octave));
  }
}

TEST_CASE("turns are even whatever azimuths are left out", "[transport][gather]") {
  for (int gathers = 3; gathers <= 12; ++gathers) {
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings) {
      std::vector<double> turns;  // in steps of those that are walked
      for (int k = 1; k <= gathers; ++k)
        turns.push_back(std::fmod(spread_turn(k) / std::ldexp(1, halvings), 1.0));
      std::sort(turns.begin(), turns.end());
      double gap = turns.front() + 1 - turns.back();
      for (std::size_t i = 1; i < turns.size(); ++i) gap = std::max(gap, turns[i] - turns[i - 1]);
      INFO(gathers << " gathers, halved " << halvings << " times");
      CHECK(gap < 2.0 / gathers);
    }
  }
}

TEST_CASE("a field that is the same everywhere is gathered as it is", "[transport][gather]") {
  const auto [name, map] = ground(GENERATE(range(0, kGrounds)));
  const int samples_per_octave = GENERATE(8, 32);
  const Surface surface = build_surface(map);
  const WalkOptions options{.azimuths = 8, .samples_per_octave = samples_per_octave, .peak_share = 0.3F};
  INFO(name << ", fineness " << samples_per_octave);
  for (const float constant : {1.0F, 0.37F, 1e-20F}) {
    const Map field = make_field(surface, [&](int, int) { return constant; });
    for (const WalkGather walk : {walk_gather, walk_gather_by_one}) {
      const GatheredMap gathered = gather_with(walk, surface, options, {field});
      for_receivers(surface, [&](std::size_t i) {
        REQUIRE(gathered.weight[i] >= 0);
        REQUIRE(gathered.weight[i] <= 1.3F);
        if (gathered.weight[i] == 0) {
          REQUIRE(gathered.weighted[0][i] == 0);
        } else if (constant == 1) {
          REQUIRE(gathered.weighted[0][i] == gathered.weight[i]);  // identity, to the last bit
        } else {
          REQUIRE(gathered.mean(0, i) == Approx(constant).epsilon(1e-6).margin(0));  // rounding of sums
        }
      });
    }
  }
}

TEST_CASE("what is gathered lies between the least and the most of a field", "[transport][gather]") {
  const auto [name, map] = ground(GENERATE(range(0, kGrounds)));
  const Surface surface = build_surface(map);
  const Map field = make_field(surface, [&](int row, int column) {
    return 5 + unit_real(hash_combine(3, surface.map.height.index(row, column)));
  });
  const GatheredMap gathered = gather_with(
      walk_gather, surface, {.azimuths = 8, .samples_per_octave = 8, .peak_share = 0.3F}, {field});
  INFO(name);
  for_receivers(surface, [&](std::size_t i) {
    if (gathered.weight[i] == 0) return;
    REQUIRE(gathered.mean(0, i) > 5 - 1e-5);  // rounding
    REQUIRE(gathered.mean(0, i) < 6 + 1e-5);
  });
}

TEST_CASE("several fields at once give each what it gives alone", "[transport][gather]") {
  const auto [name, map] = ground(GENERATE(0, 3, 5, 8));
  const Surface surface = build_surface(map);
  const WalkOptions options{.azimuths = 8, .samples_per_octave = 8, .peak_share = 0.3F};
  std::vector<Map> fields;
  for (std::uint64_t seed = 0; seed < kMostFields; ++seed) fields.push_back(noisy_field(surface, seed));
  INFO(name);
  for (const WalkGather walk : {walk_gather, walk_gather_by_one}) {
    for (std::size_t count = 2; count <= kMostFields; ++count) {
      const std::vector<Map> some(fields.end() - static_cast<std::ptrdiff_t>(count), fields.end());
      const GatheredMap together = gather_with(walk, surface, options, some);
      for (std::size_t f = 0; f < count; ++f) {
        const GatheredMap alone = gather_with(walk, surface, options, {some[f]});
        CHECK(alone.weight == together.weight);
        CHECK(alone.weighted[0] == together.weighted[f]);
      }
    }
  }
}

/// RMS, over every `step`-th receiver, of (1 − A) × the mean seen less what exact walks gather along the same
/// azimuths.
double error_against_exact(const Surface& surface, const WalkOptions& options, const Map& field,
                           std::size_t step) {
  const GatheredMap gathered = gather_with(walk_gather, surface, options, {field});
  const ExactWalker walker(surface, options.azimuths);
  const auto width = static_cast<std::size_t>(surface.width());
  std::vector<double> errors((field.size() + step - 1) / step);
  parallel_for(static_cast<std::int64_t>(errors.size()), [&](std::int64_t k) {
    const std::size_t i = static_cast<std::size_t>(k) * step;
    SliceView view;
    walker.view(static_cast<int>(i / width), static_cast<int>(i % width), view);
    const double exact =
        gather_exactly(view, surface, [&](std::size_t seen) { return double{field.values[seen]}; });
    const double seen = gathered.weight[i] > 0 ? gathered.mean(0, i) : double{field.values[i]};
    errors[static_cast<std::size_t>(k)] = (1 - view.sky_view_factor) * seen - exact;
  });
  double squares = 0;
  for (const double error : errors) squares += error * error;
  return std::sqrt(squares / static_cast<double>(errors.size()));
}

/// A, as exact walks along a few azimuths find it: the light that the first bounce gathers.
Map sky_of(const Surface& surface) {
  const ExactWalker walker(surface, 16);
  Map sky(surface.width(), surface.height());
  parallel_for(sky.height, [&](std::int64_t row) {
    SliceView view;
    for (int column = 0; column < sky.width; ++column) {
      walker.view(static_cast<int>(row), column, view);
      sky(static_cast<int>(row), column) = static_cast<float>(view.sky_view_factor);
    }
  });
  return sky;
}

TEST_CASE("gathers among bricks are exact ones along the same azimuths, but for where walks look",
          "[transport][gather]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  struct Step {
    double relief, bound;
  };
  // discretisation: what comes into sight of walls between two samples stands where its middle lies
  // (measured, the worse of both: 3.9e-4, 1.5e-3, 1.8e-3)
  for (const auto& [relief, bound] : {Step{0.1, 5e-4}, Step{0.4, 1.7e-3}, Step{1, 2e-3}}) {
    const Surface surface = build_surface(make_synth_map("brick", 64, boundary, relief));
    const double error = error_against_exact(
        surface, {.azimuths = 48, .samples_per_octave = 48, .peak_share = 0.3F}, sky_of(surface), 3);
    INFO("relief " << relief << ", " << to_string(boundary) << ": " << error);
    CHECK(error < bound);
  }
}

TEST_CASE("receivers on walls ever so steep see what is there", "[transport][gather]") {
  const double depth = GENERATE(0.5, 2.0, 8.0);  // slopes of normals up to 23, 91 and 362
  const Surface surface = build_surface(make_map(64, 64, Boundary::tile, [&](int row, int column) {
    return column % 32 >= 8 && column % 32 <= 24 && row % 32 > 4 ? 0.0 : depth;
  }));
  const double error = error_against_exact(
      surface, {.azimuths = 48, .samples_per_octave = 48, .peak_share = 0.3F}, sky_of(surface), 3);
  INFO("depth " << depth << ": " << error);
  CHECK(error < 3e-3);  // discretisation, as above (measured: 9e-4 to 2.0e-3)
}

TEST_CASE("gathers of a smooth field come near exact ones, ever nearer with azimuths and fineness",
          "[transport][gather][slow]") {
  constexpr int kSize = 128;
  constexpr int kTried = 512;
  const std::string shape = GENERATE("brick", "fbm", "sines");
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_synth_map(shape.c_str(), kSize, boundary, 0.1));
  const Map field = smooth_map(surface);
  const ExactWalker walker(surface, 128);
  std::vector<double> exact(kTried);
  std::vector<double> share(kTried);
  const auto texel = [](std::size_t i) { return scramble(i) % (kSize * kSize); };
  parallel_for(kTried, [&](std::int64_t k) {
    const auto i = static_cast<std::size_t>(k);
    const int at = static_cast<int>(texel(i));
    SliceView view;
    walker.view(at / kSize, at % kSize, view);
    share[i] = 1 - view.sky_view_factor;
    exact[i] = gather_exactly(view, surface, [&](std::size_t seen) { return double{field.values[seen]}; });
  });
  struct Step {
    int azimuths, samples_per_octave;
    double bound;
  };
  // discretisation: of azimuths and of samples, and of blocks where light is read (measured, the worst of the
  // six maps: 3.5e-3, 1.3e-3, 6.4e-4 of a field of order 1, of which up to 0.14 is gathered)
  for (const auto& [azimuths, samples_per_octave, bound] :
       {Step{8, 8, 5e-3}, Step{16, 16, 1.8e-3}, Step{32, 32, 8e-4}}) {
    const GatheredMap gathered = gather_with(
        walk_gather, surface,
        {.azimuths = azimuths, .samples_per_octave = samples_per_octave, .peak_share = 0.3F}, {field});
    double squares = 0;
    for (std::size_t i = 0; i < kTried; ++i) {
      const std::size_t at = texel(i);
      const double seen = gathered.weight[at] > 0 ? gathered.mean(0, at) : double{field.values[at]};
      squares += std::pow(share[i] * seen - exact[i], 2);
    }
    INFO(shape << ", " << to_string(boundary) << ", " << azimuths
               << " azimuths: " << std::sqrt(squares / kTried));
    CHECK(std::sqrt(squares / kTried) < bound);
  }
}

/// Gathers a field over a whole map, as maps are gathered.
GatheredMap gather_map(const Surface& surface, const MapGather& gather, const GatherTurn& turn,
                       const Map& field) {
  FieldPyramid pyramid = gather.make_pyramid();
  pyramid.fill(field);
  GatheredMap result;
  result.weight.resize(field.size());
  result.weighted.assign(1, result.weight);
  gather.run(turn, {&pyramid}, [&](const ReceiverTile& tile, const GatherSums& sums) {
    for (int row = 0; row < tile.rows; ++row) {
      for (int column = 0; column < tile.columns; ++column) {
        const auto at = static_cast<std::size_t>(row * ReceiverTile::kSide + column);
        const std::size_t texel = surface.map.height.index(tile.first_row + row, tile.first_column + column);
        result.weight[texel] = sums.weight[at];
        result.weighted[0][texel] = sums.weighted[0][at];
      }
    }
  });
  return result;
}

TEST_CASE("gathers over maps are those of their tiles, on any number of threads", "[transport][gather]") {
  const Surface surface = build_surface(make_rough_map(150, 131, Boundary::tile, 0.3, 0.1, 6));
  const WalkOptions options{.azimuths = 6, .samples_per_octave = 8, .peak_share = 0.3F};
  const Map field = noisy_field(surface, 1);
  const GatheredMap expected = gather_with(walk_gather, surface, options, {field});
  for (const int threads : {1, 3}) {
    const ThreadScope scope(threads);
    const MapGather gather(surface, build_height_pyramid(surface), options);
    const GatheredMap got = gather_map(surface, gather, {.azimuths = 6}, field);
    for_receivers(surface, [&](std::size_t i) {
      REQUIRE(got.weight[i] == expected.weight[i]);
      REQUIRE(got.weighted[0][i] == expected.weighted[0][i]);
    });
  }
}

TEST_CASE("strips of a tile are gathered as the whole is", "[transport][gather]") {
  const Surface surface = build_surface(make_synth_map("brick", 96, Boundary::tile, 0.2));
  const WalkOptions options{.azimuths = 6, .samples_per_octave = 8, .peak_share = 0.3F};
  const MapGather gather(surface, build_height_pyramid(surface), options);
  const Map field = noisy_field(surface, 1);
  const GatheredMap expected = gather_map(surface, gather, {.azimuths = 6}, field);
  FieldPyramid pyramid = gather.make_pyramid();
  pyramid.fill(field);
  std::vector<TileFrame> strips;
  for (const int row : {0, 32, 36, 92}) {
    TileFrame& strip = strips.emplace_back();
    strip.first_row = row;
    strip.first_column = 64;
    strip.rows = 4;
    strip.columns = 32;
  }
  gather.run_on(strips, {.azimuths = 6}, {&pyramid},
                [&](std::size_t index, const ReceiverTile& tile, const GatherSums& sums) {
                  for (int row = 0; row < 4; ++row) {
                    for (int column = 0; column < 32; ++column) {
                      const auto at = static_cast<std::size_t>(row * ReceiverTile::kSide + column);
                      const std::size_t texel =
                          surface.map.height.index(strips[index].first_row + row, 64 + column);
                      if (sums.weight[at] != expected.weight[texel] ||
                          sums.weighted[0][at] != expected.weighted[0][texel] || !tile.present[at])
                        throw std::logic_error("a strip's receiver sees something else");
                    }
                  }
                });
}

TEST_CASE("receivers that see less walk fewer azimuths, as evenly spread", "[transport][gather]") {
  CHECK(azimuth_halvings(1) == 0);
  for (double share = 0; share < 1; share += 0.01)
    CHECK(azimuth_halvings(share) >= azimuth_halvings(share + 0.01));
  const int azimuths = GENERATE(2, 4, 6, 8, 10, 12, 16, 24, 48);
  const Surface surface = build_surface(make_synth_map("brick", 70, Boundary::open, 0.3));
  const MapGather gather(surface, build_height_pyramid(surface),
                         {.samples_per_octave = 8, .peak_share = 0.3F});
  const Map field = noisy_field(surface, 1);
  for (const double share : {0.5, 0.2, 0.1, 0.02}) {
    const int part = azimuths / halved_azimuths(azimuths, azimuth_halvings(share));
    const Map sky(70, 70, static_cast<float>(1 - share));
    const GatheredMap got =
        gather_map(surface, gather, {.azimuths = azimuths, .turn = 0.25, .sky = &sky}, field);
    const GatherTurn fewer{.azimuths = azimuths / part, .turn = 0.25 / part};
    const GatheredMap expected = gather_map(surface, gather, fewer, field);
    double worst = 0;
    for (std::size_t i = 0; i < field.size(); ++i) {
      worst = std::max({worst, std::fabs(double{got.weight[i]} - double{expected.weight[i]}),
                        std::fabs(double{got.weighted[0][i]} - double{expected.weighted[0][i]})});
    }
    INFO(azimuths << " azimuths, a share of " << share << ": " << worst);
    CHECK(worst < 1e-4);  // rounding of sums, and of azimuths
  }
  const Map open(70, 70, 1);
  const GatheredMap nothing = gather_map(surface, gather, {.azimuths = azimuths, .sky = &open}, field);
  CHECK(nothing.weight == std::vector<float>(field.size(), 0));
}

}  // namespace
}  // namespace heightlight
