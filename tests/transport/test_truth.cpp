#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "test_maps.h"
#include "transport/simulated.h"

// Maps that another program path traced on the same mesh. It shades flat facets and averages over each
// texel's footprint, so smooth fields are compared by their means and by averages over 8 × 8 texels, the two
// outermost texels left out. Rays and horizon walks differ from it alike, by what shading differs.

namespace heightlight {
namespace {

constexpr int kSize = 256;
constexpr int kBorder = 2;
constexpr int kBlock = 8;

using Field = std::vector<float>;

std::optional<Field> read_truth(const std::string& name) {
  const std::filesystem::path path =
      std::filesystem::path(HEIGHTLIGHT_SHARED_DIR) / "truth" / (name + ".f32");
  std::ifstream file(path, std::ios::binary);
  Field values(static_cast<std::size_t>(kSize) * kSize);
  file.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(float)));
  if (file) return values;
  WARN("SKIPPED: shared truth absent: " << path.string());
  return std::nullopt;
}

struct Difference {
  double mean = 0;
  double block_rmse = 0;
};

/// `ours` − `truth` over the texels that `included` names.
template <class Included>
Difference compare(const TexelVector& ours, const Field& truth, Included&& included) {
  Difference result;
  double squares = 0;
  int blocks = 0;
  int texels = 0;
  for (int top = 0; top < kSize; top += kBlock) {
    for (int left = 0; left < kSize; left += kBlock) {
      double sum = 0;
      int count = 0;
      for (int row = top; row < top + kBlock; ++row) {
        for (int column = left; column < left + kBlock; ++column) {
          const bool inside =
              row >= kBorder && row < kSize - kBorder && column >= kBorder && column < kSize - kBorder;
          if (!inside || !included(row, column)) continue;
          const int i = row * kSize + column;
          sum += ours[i] - static_cast<double>(truth[static_cast<std::size_t>(i)]);
          ++count;
        }
      }
      result.mean += sum;
      texels += count;
      if (count < kBlock * kBlock) continue;  // partial blocks average less of the truth's noise away
      squares += sum / count * (sum / count);
      ++blocks;
    }
  }
  result.mean /= texels;
  result.block_rmse = std::sqrt(squares / blocks);
  return result;
}

/// Truth maps of a field, with the sum of bounces each stands for.
struct Case {
  const char* suffix;
  double albedo;
  int last_bounce;
};
constexpr Case kCases[] = {{"E0", 1, 0},        {"E_rho1_1b", 1, 1},       {"E_rho1_2b", 1, 2},
                           {"E_rho1_3b", 1, 3}, {"E_rho0.5_20b", 0.5, 20}, {"E_rho0.8_20b", 0.8, 20}};

template <class Included>
void check_field(const std::string& heights, const std::string& field, Boundary boundary,
                 Included&& included) {
  const Finder finder = GENERATE(by_rays(512), by_horizon_walks());
  const std::optional<Field> height = read_truth(heights + "_height");
  if (!height) return;
  const Simulated ours = simulate_map(
      make_map(
          kSize, kSize, boundary,
          [&](int row, int column) { return (*height)[static_cast<std::size_t>(row * kSize + column)]; }),
      finder);
  for (const Case& which : kCases) {
    const std::optional<Field> truth = read_truth(field + "__" + which.suffix);
    if (!truth) continue;
    const Difference d = compare(sum_of_bounces(ours, which.albedo, which.last_bounce), *truth, included);
    INFO(field << " " << which.suffix << " by " << finder.name << ": mean " << d.mean << ", block RMSE "
               << d.block_rmse);
    CHECK(std::fabs(d.mean) < 0.002);
    CHECK(d.block_rmse < 0.004);
  }
}

TEST_CASE("sines of relief 0.10, open, match the path tracer", "[transport][truth][slow]") {
  check_field("sines_a10", "sines_a10", Boundary::open, [](int, int) { return true; });
}

TEST_CASE("sines of relief 0.25, open, match the path tracer", "[transport][truth][slow]") {
  check_field("sines_a25", "sines_a25", Boundary::open, [](int, int) { return true; });
}

TEST_CASE("sines of relief 0.10, tiled, match the path tracer's centre of nine by nine",
          "[transport][truth][slow]") {
  check_field("sines_a10", "sines_a10_tiled9", Boundary::tile, [](int, int) { return true; });
}

TEST_CASE("a bowl of depth 0.25 matches the path tracer away from its rim", "[transport][truth][slow]") {
  check_field("bowl_a25", "bowl_a25", Boundary::open, [](int row, int column) {
    const double distance = std::hypot(row + 0.5 - kSize / 2, column + 0.5 - kSize / 2);
    return std::fabs(distance - 0.35 * kSize) > 2;
  });
}

}  // namespace
}  // namespace heightlight
