#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "heightmap/synth_noise.h"

using namespace heightlight::synth;

// A step between neighbouring texels hides a seam that lies inside the map; so the fields themselves are
// walked along.
TEST_CASE("Noise repeats with period 1 and has no seam anywhere", "[synth]") {
  constexpr int kPoints = 4000;
  for (const int frequency : {1, 2, 3, 30}) {
    const TiledNoise noise(frequency, 2 * frequency, 17);
    // In a cell, the slopes differ by at most 2 and the fade's steepest rise is 15/8 per axis; the gradients
    // add 1 each.
    const double steepest = 1.6 * (2 * 15.0 / 8 + 1) * 2 * frequency;
    for (int i = 0; i < kPoints; ++i) {
      const double t = (i + 0.3) / kPoints;
      const double other = std::fmod(37 * t, 1.0);
      CAPTURE(frequency, t);
      // Identity: u + 1 is rounded to 2⁻⁵², which the slope magnifies.
      CHECK(noise(t + 1, other - 1) == Approx(noise(t, other)).margin(1e-12));
      CHECK(std::abs(noise(t + 1.0 / kPoints, other) - noise(t, other)) <= steepest / kPoints);
      CHECK(std::abs(noise(other, t + 1.0 / kPoints) - noise(other, t)) <= steepest / kPoints);
    }
  }
}

// Monte Carlo with fixed seeds: 20 fields of 900 cells, so the mean of about 18000 independent values of
// deviation 0.28 has a standard error of 0.002, the deviation one of 0.0015; four of each are allowed.
TEST_CASE("Noise has the mean, the deviation and the bound that its header states", "[synth]") {
  constexpr int kPoints = 150;
  double sum = 0;
  double squares = 0;
  double largest = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TiledNoise noise(30, 30, seed);
    for (int row = 0; row < kPoints; ++row) {
      for (int column = 0; column < kPoints; ++column) {
        const double value = noise((column + 0.5) / kPoints, (row + 0.5) / kPoints);
        sum += value;
        squares += value * value;
        largest = std::max(largest, std::abs(value));
      }
    }
  }
  const double count = 20.0 * kPoints * kPoints;
  CHECK(sum / count == Approx(0).margin(0.008));
  CHECK(std::sqrt(squares / count) == Approx(0.28).margin(0.006 + 0.005));  // the header rounds to two digits
  CHECK(largest <= 1.6);
}

TEST_CASE("Octaves stop where told, and keep the first", "[synth]") {
  const Octaves one(8, 4, 0.5, 3);
  const Octaves also_one(8, 15, 0.5, 3);
  const Octaves two(8, 16, 0.5, 3);
  CHECK(one(0.3, 0.7) == also_one(0.3, 0.7));
  CHECK(one(0.3, 0.7) != two(0.3, 0.7));
}

// Spots lie inside their cells: a walk around every cell's border meets none. The share of cells with a spot
// is binomial: 4096 cells at 0.3 have a standard error of 0.0072.
TEST_CASE("Spots stay in their cells and cover the share asked for", "[synth]") {
  constexpr int kCells = 64;
  const Spots spots(kCells, 0.3, 0.3, 0.5, 9);
  int found = 0;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      bool inside = false;
      for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < 16; ++j) {
          inside = inside || spots((x + (i + 0.5) / 16) / kCells, (y + (j + 0.5) / 16) / kCells).distance < 1;
        }
        CHECK(spots((x + 1e-9) / kCells, (y + i / 16.0) / kCells).distance >= 1 - 1e-6);
        CHECK(spots((x + i / 16.0) / kCells, (y + 1e-9) / kCells).distance >= 1 - 1e-6);
      }
      found += inside ? 1 : 0;
    }
  }
  CHECK(found / static_cast<double>(kCells * kCells) == Approx(0.3).margin(4 * 0.0072));
}
