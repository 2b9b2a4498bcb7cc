#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "screenspace/bilateral_gather.h"
#include "test_maps.h"
#include "visibility/walked_tiles.h"

namespace heightlight {
namespace {

std::vector<Map> random_results(int width, int height, std::size_t count) {
  std::vector<Map> results(count, Map(width, height));
  std::uint64_t salt = 0;
  for (Map& result : results) {
    for (float& value : result.values) value = static_cast<float>(unit_real(scramble(++salt)));
  }
  return results;
}

TEST_CASE("the gather's lanes and its scalar twin agree on every instruction set", "[screenspace]") {
  const auto [width, height] = GENERATE(std::pair{61, 9}, std::pair{1, 1}, std::pair{2, 5}, std::pair{12, 3});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Surface surface = build_surface(make_rough_map(width, height, boundary, 0.1, 0.15, 4));
  const DepthBuffer depth = make_depth_buffer(surface);
  const std::vector<Map> results = random_results(width, height, 5);
  const GatherPass pass{depth, results, 0.04F};
  std::vector<Map> twin(5, Map(width, height));
  for (int row = 0; row < height; ++row) gather_row_scalar(pass, row, 0, width, twin);
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    std::vector<Map> lanes(5, Map(width, height));
    for (int row = 0; row < height; ++row) gather_row(pass, row, lanes);
    for (std::size_t c = 0; c < 5; ++c) {
      for (std::size_t i = 0; i < twin[c].size(); ++i) {
        const float a = lanes[c].values[i];
        const float b = twin[c].values[i];
        INFO(hwy::TargetName(target) << ", " << width << " × " << height << ", texel " << i);
        REQUIRE((a == b || (std::isnan(a) && std::isnan(b))));  // identity: the same sums in the same order
      }
    }
  }
}

TEST_CASE("results of the same plane are averaged, of another they are not", "[screenspace]") {
  // Two tilted planes, a cliff of many texels between them.
  const Surface surface = build_surface(make_map(64, 16, Boundary::open, [](int row, int column) {
    return (column < 32 ? 0.0 : 0.5) + 0.01 * column - 0.003 * row;
  }));
  const DepthBuffer depth = make_depth_buffer(surface);
  std::vector<Map> results(1, Map(64, 16));
  for (int row = 0; row < 16; ++row) {
    for (int column = 0; column < 64; ++column) {
      results[0](row, column) = static_cast<float>((column < 32 ? 0 : 1000) + (row % 4) * 4 + column % 4);
    }
  }
  const Map mean = gather_bilaterally(depth, results)[0];
  for (const int column : {8, 20, 27, 40, 55}) {
    const float base = column < 32 ? 0.0F : 1000.0F;
    CHECK(mean(8, column) == base + 7.5F);  // all sixteen values of the square
  }
  CHECK(mean(8, 36) == 1007.5F);
  CHECK(mean(8, 33) > 900);  // never mixed across the cliff
}

}  // namespace
}  // namespace heightlight
