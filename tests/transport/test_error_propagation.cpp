#include <catch2/catch.hpp>
#include <cmath>

#include "base/hash.h"
#include "base/root_mean.h"
#include "test_maps.h"
#include "transport/calibration_frames.h"
#include "transport/error_propagation.h"

namespace heightlight {
namespace {

constexpr std::size_t kPassedReceivers = 512;

/// From −1 to 1, of variance 1/3.
double noise(std::uint64_t seed, std::size_t i) { return 2 * unit_real(hash_combine(seed, i)) - 1; }

/// Receivers that see `seen` of their own class and nothing else.
std::vector<FoundError> make_receivers(double seen) {
  std::vector<FoundError> found(kPassedReceivers);
  for (std::size_t i = 0; i < kPassedReceivers; ++i) {
    found[i].own_class = i % SkyClasses::kCount;
    found[i].seen[found[i].own_class] = seen;
  }
  return found;
}

TEST_CASE("an error that all receivers share is passed on as the geometric series", "[transport]") {
  const double seen = GENERATE(0.1, 0.5, 0.9);
  std::vector<FoundError> found = make_receivers(seen);
  for (FoundError& error : found) error.residual = 0.001;
  for (const double error : propagate_errors(found)) CHECK(error == Approx(0.001 / (1 - seen)));
}

TEST_CASE("an error that each receiver has for itself is not passed on", "[transport]") {
  const double seen = GENERATE(0.1, 0.5, 0.9);
  const std::uint64_t seed = GENERATE(1, 2, 3);
  std::vector<FoundError> found = make_receivers(seen);
  for (std::size_t i = 0; i < kPassedReceivers; ++i) {
    found[i].residual = noise(seed, i);
    found[i].place = FoundError::SeenPlace{.residual = noise(seed + 10, i), .own_class = i % 16};
  }
  const double own = std::sqrt(1.0 / 3);
  const double propagated = root_mean_square(propagate_errors(found));
  // What 512 receivers tell by chance: means of 32 each, and a regression of them all.
  CHECK(propagated > 0.9 * own);
  CHECK(propagated < (seen < 0.8 ? 1.3 : 2.2) * own);
}

TEST_CASE("an error that a receiver shares with what it sees is passed on", "[transport]") {
  const double seen = GENERATE(0.1, 0.5, 0.9);
  std::vector<FoundError> found = make_receivers(seen);
  for (std::size_t i = 0; i < kPassedReceivers; ++i) {
    found[i].residual = (i / SkyClasses::kCount) % 2 == 0 ? 0.001 : -0.001;  // no class has a mean
    found[i].place = FoundError::SeenPlace{.residual = found[i].residual, .own_class = found[i].own_class};
  }
  for (const double error : propagate_errors(found)) CHECK(std::abs(error) == Approx(0.001 / (1 - seen)));
}

TEST_CASE("calibration samples lie on the map, on the grid of what is walked together", "[transport]") {
  const Surface surface = build_surface(make_synth_map("brick", 100, Boundary::tile, 0.1));
  constexpr CalibrationShape kShape{.rows = 2, .columns = 16};
  const std::vector<TileFrame> frames = pick_frames(surface, kShape, 200, 1);
  CHECK(frames.size() == 200);
  for (const TileFrame& frame : frames) {
    CHECK(frame.first_row % kShape.rows == 0);
    CHECK(frame.first_column % TileFrame::kSide % kShape.columns == 0);
    CHECK((frame.rows >= 1 && frame.first_row + frame.rows <= 100));
    CHECK((frame.columns >= 1 && frame.first_column + frame.columns <= 100));
    for (std::uint64_t i = 0; i < 4; ++i) {
      const FrameTexel texel = pick_in_frame(frame, i, 4, 7);
      CHECK((texel.row >= frame.first_row && texel.row < frame.first_row + frame.rows));
      CHECK((texel.column >= frame.first_column && texel.column < frame.first_column + frame.columns));
    }
  }
}

}  // namespace
}  // namespace heightlight
