#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "screenspace/slice_samples.h"
#include "test_maps.h"

namespace heightlight {
namespace {

DepthBuffer flat_depth(int width, int height, Boundary boundary) {
  return make_depth_buffer(build_surface(make_map(width, height, boundary, [](int, int) { return 0.0; })));
}

std::vector<double> sorted_azimuths(DirectionNoise noise, int slices) {
  const DepthBuffer depth = flat_depth(32, 32, Boundary::tile);
  std::vector<double> azimuths;
  for (int frame = 0; frame < frame_count(noise); ++frame) {
    const SliceTables tables = make_slice_tables(depth,
                                                 {.slices = slices,
                                                  .steps = 1,
                                                  .distribution = StepDistribution::uniform,
                                                  .sampling = DepthSampling::nearest,
                                                  .noise = noise,
                                                  .radius = 0.5},
                                                 frame);
    for (const std::vector<Slice>& table : tables.of) {
      for (const Slice& slice : table) azimuths.push_back(std::atan2(double{slice.y}, double{slice.x}));
    }
  }
  std::sort(azimuths.begin(), azimuths.end());
  return azimuths;
}

TEST_CASE("any square of 4 × 4 texels holds all ranks of the noise", "[screenspace]") {
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      std::set<int> ranks;
      for (int i = 0; i < 16; ++i) ranks.insert(noise_rank(row + i / 4, column + i % 4));
      CHECK(ranks.size() == 16);
    }
  }
}

TEST_CASE("noise makes 1, 16 or 96 directions of one, all equally far apart", "[screenspace]") {
  const int slices = GENERATE(1, 3);
  for (const auto& [noise, count] :
       {std::pair{DirectionNoise::none, 1}, std::pair{DirectionNoise::spatial, 16},
        std::pair{DirectionNoise::temporal, 96}}) {
    const std::vector<double> azimuths = sorted_azimuths(noise, slices);
    REQUIRE(azimuths.size() == static_cast<std::size_t>(count * slices));
    const double step = std::numbers::pi / (count * slices);
    for (std::size_t i = 1; i < azimuths.size(); ++i) {
      REQUIRE(azimuths[i] - azimuths[i - 1] == Approx(step).epsilon(1e-4));  // rounding of floats
    }
  }
}

TEST_CASE("six turns by sixths of a slice's half turn are only three beside the spatial noise",
          "[screenspace]") {
  std::set<long> directions;  // in 48ths of a half turn
  for (int rank = 0; rank < 16; ++rank) {
    for (int frame = 0; frame < 6; ++frame) directions.insert((3 * rank + 8 * frame) % 48);
  }
  CHECK(directions.size() == 48);  // of 96
}

TEST_CASE("samples on the mesh weigh three texels by where they lie", "[screenspace]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const DepthBuffer depth = flat_depth(20, 30, boundary);
  const SliceTables tables = make_slice_tables(depth,
                                               {.slices = 5,
                                                .steps = 9,
                                                .distribution = StepDistribution::quadratic,
                                                .sampling = DepthSampling::mesh,
                                                .noise = DirectionNoise::spatial,
                                                .radius = 0.7},
                                               0);
  const auto from_receiver = [](int offset, int period) {
    return offset > period / 2 ? offset - period : offset;
  };
  int samples = 0;
  for (const std::vector<Slice>& table : tables.of) {
    for (const Slice& slice : table) {
      for (std::size_t side = 0; side < 2; ++side) {
        for (const SliceSample& sample : slice.sides[side]) {
          double weights = 0;
          double u = 0;
          double v = 0;
          for (const DepthTap& tap : sample.taps) {
            REQUIRE(tap.weight >= 0);
            weights += double{tap.weight};
            u += double{tap.weight} * from_receiver(tap.column, depth.period_columns);
            v += double{tap.weight} * from_receiver(tap.row, depth.period_rows);
          }
          const double distance = double{sample.distance};
          CHECK(weights * distance == Approx(1).epsilon(1e-5));
          if (boundary == Boundary::tile) continue;  // farther than half a period: elsewhere on the torus
          const double sign = side == 0 ? -1 : 1;
          const double texel = 1.0 / 20;
          CHECK(u * distance * texel == Approx(sign * double{slice.x} * distance).margin(1e-5));
          CHECK(v * distance * texel == Approx(-sign * double{slice.y} * distance).margin(1e-5));
          ++samples;
        }
      }
    }
  }
  CHECK((boundary == Boundary::tile || samples > 1000));
}

TEST_CASE("the nearest sample is never the receiver, and knows its own distance", "[screenspace]") {
  const DepthBuffer depth = flat_depth(64, 64, Boundary::tile);
  const SliceTables tables = make_slice_tables(depth,
                                               {.slices = 7,
                                                .steps = 16,
                                                .distribution = StepDistribution::quadratic,
                                                .sampling = DepthSampling::nearest,
                                                .noise = DirectionNoise::spatial,
                                                .radius = 0.2},
                                               0);
  for (const std::vector<Slice>& table : tables.of) {
    for (const Slice& slice : table) {
      for (const std::vector<SliceSample>& side : slice.sides) {
        CHECK(side.size() == 16);
        for (const SliceSample& sample : side) {
          const int column = (sample.taps[0].column + 32) % 64 - 32;
          const int row = (sample.taps[0].row + 32) % 64 - 32;
          REQUIRE((row != 0 || column != 0));
          REQUIRE(double{sample.distance} == Approx(std::hypot(row, column) / 64));
          REQUIRE(double{sample.taps[0].weight} * double{sample.distance} == Approx(1));
        }
      }
    }
  }
}

}  // namespace
}  // namespace heightlight
