#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/synth.h"

using namespace heightlight;

namespace {

// FNV-1a over the bits of the heights, low byte first whatever the machine.
std::uint64_t fingerprint(const Image<float>& image) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const float height : image.values) {
    const auto bits = std::bit_cast<std::uint32_t>(height);
    for (int shift = 0; shift < 32; shift += 8) hash = (hash ^ ((bits >> shift) & 0xffU)) * 0x100000001b3ULL;
  }
  return hash;
}

double coordinate(int index, int size) { return (index + 0.5) / size; }

struct Steps {
  double across;
  double largest_inside;
};

double column_step(const Image<float>& image, int from, int to) {
  double sum = 0;
  for (int row = 0; row < image.height; ++row) sum += std::pow(image(row, from) - image(row, to), 2);
  return std::sqrt(sum / image.height);
}

double row_step(const Image<float>& image, int from, int to) {
  double sum = 0;
  for (int column = 0; column < image.width; ++column)
    sum += std::pow(image(from, column) - image(to, column), 2);
  return std::sqrt(sum / image.width);
}

// Root mean square steps: between the last line and the first, and the largest between neighbouring lines
// inside.
template <class LineStep>
Steps measure_steps(const Image<float>& image, const LineStep& step) {
  Steps steps{step(image, image.width - 1, 0), 0};
  for (int i = 0; i + 1 < image.width; ++i)
    steps.largest_inside = std::max(steps.largest_inside, step(image, i, i + 1));
  return steps;
}

}  // namespace

// Golden values: the maps are made of exactly rounded operations only, so every bit is the same on every
// machine. A change here changes every result that was computed from a made heightmap, and is to be a
// decision.
TEST_CASE("Every shape keeps every bit", "[synth]") {
  const std::map<std::string, std::uint64_t> golden{
      {"flat", 0xbe7134315f056325ULL},     {"plane", 0xcf57323e835c34a5ULL},
      {"bowl", 0x41d76e446a916e9dULL},     {"trench", 0xfed4632e9ec62b25ULL},
      {"groove", 0xc67c93829e8c1ca5ULL},   {"cliff", 0xe8a3c8e0aee89325ULL},
      {"steps", 0xfc3e8d7e99c10425ULL},    {"sines", 0x694d28cf4734e82bULL},
      {"fbm", 0xfa115d138202b6c6ULL},      {"cobbles", 0x10ddee006b968e5fULL},
      {"brick", 0xc966579c5b6dfff2ULL},    {"shapes", 0x71deb8cea44d791dULL},
      {"concrete", 0x1c7cf7f42273d733ULL},
  };
  REQUIRE(golden.size() == synth_shapes().size());
  for (const SynthShape& shape : synth_shapes()) {
    CAPTURE(shape.name);
    CHECK(fingerprint(synthesize(shape.name, 96, 1)) == golden.at(shape.name));
  }
}

TEST_CASE("A shape does not depend on the number of threads", "[synth]") {
  for (const SynthShape& shape : synth_shapes()) {
    CAPTURE(shape.name);
    const auto of_threads = [&](int threads) {
      const ThreadScope scope(threads);
      return synthesize(shape.name, 61, 5);
    };
    CHECK(of_threads(3) == of_threads(1));
  }
}

TEST_CASE("The seed, all 64 bits of it, changes the natural shapes and no other", "[synth]") {
  const std::set<std::string> natural{"fbm", "cobbles", "brick", "concrete"};
  for (const SynthShape& shape : synth_shapes()) {
    CAPTURE(shape.name);
    const Image<float> first = synthesize(shape.name, 48, 1);
    CHECK((synthesize(shape.name, 48, 2) != first) == natural.contains(shape.name));
    CHECK((synthesize(shape.name, 48, 1 + (1ULL << 32)) != first) == natural.contains(shape.name));
  }
}

TEST_CASE("Heights lie in [0, 1] at every size, and the natural shapes reach both ends", "[synth]") {
  for (const SynthShape& shape : synth_shapes()) {
    for (const int size : {1, 2, 3, 7, 64, 129}) {
      CAPTURE(shape.name, size);
      const Image<float> image = synthesize(shape.name, size, 3);
      REQUIRE(image.width == size);
      REQUIRE(image.height == size);
      const auto [lowest, highest] = std::minmax_element(image.values.begin(), image.values.end());
      CHECK(*lowest >= 0);
      CHECK(*highest <= 1);
      const bool natural =
          shape.name == "fbm" || shape.name == "cobbles" || shape.name == "brick" || shape.name == "concrete";
      if (natural && size > 1) {
        CHECK(*lowest == 0);
        CHECK(*highest == 1);
      }
    }
  }
}

// A seam would stand out as a step larger than any between lines inside. Joints of a brick wall are such
// lines too, hence the largest inside and not the mean; a quarter more allows for the luck of one line among
// a few hundred.
TEST_CASE("Shapes that tile wrap without a seam, at sizes that are no powers of two as well", "[synth]") {
  for (const SynthShape& shape : synth_shapes()) {
    if (!shape.tiles) continue;
    for (const int size : {200, 256, 321}) {
      for (const std::uint64_t seed : {1, 2}) {
        CAPTURE(shape.name, size, seed);
        const Image<float> image = synthesize(shape.name, size, seed);
        const Steps in_x = measure_steps(image, column_step);
        const Steps in_y = measure_steps(image, row_step);
        CHECK(in_x.across <= 1.25 * in_x.largest_inside);
        CHECK(in_y.across <= 1.25 * in_y.largest_inside);
      }
    }
  }
}

// The lattice of every octave is the same at both sizes; only the finest octaves differ. At three times the
// size, each texel centre of the small map is a texel centre of the large one.
TEST_CASE("A larger map is the same terrain with more detail", "[synth]") {
  constexpr int kSmall = 64;
  const Image<float> small = synthesize("fbm", kSmall, 4);
  const Image<float> large = synthesize("fbm", 3 * kSmall, 4);
  double sum = 0;
  for (int row = 0; row < kSmall; ++row) {
    for (int column = 0; column < kSmall; ++column) {
      sum += std::pow(small(row, column) - large(3 * row + 1, 3 * column + 1), 2);
    }
  }
  // Octaves 64 and up: 0.28/16/√(1 − ¼) ≈ 0.02 of a range of about 2, and the ends of the range move as much.
  CHECK(std::sqrt(sum / (kSmall * kSmall)) < 0.04);
}

TEST_CASE("Simple shapes are their formulas", "[synth]") {
  constexpr int kSize = 40;
  const Image<float> plane = synthesize("plane", kSize, 1);
  const Image<float> trench = synthesize("trench", kSize, 1);
  const Image<float> groove = synthesize("groove", kSize, 1);
  const Image<float> cliff = synthesize("cliff", kSize, 1);
  const Image<float> steps = synthesize("steps", kSize, 1);
  for (int row : {0, 13, kSize - 1}) {
    for (int column = 0; column < kSize; ++column) {
      CAPTURE(row, column);
      const double u = coordinate(column, kSize);
      CHECK(plane(row, column) == static_cast<float>(u));
      CHECK(trench(row, column) == (column >= 15 && column < 25 ? 0.F : 1.F));
      CHECK(groove(row, column) == static_cast<float>(std::min(1.0, 4 * std::abs(u - 0.5))));
      CHECK(cliff(row, column) == (column < 20 ? 0.F : 1.F));
      CHECK(steps(row, column) == static_cast<float>(column / 5 / 7.0));
    }
  }
  const Image<float> level = synthesize("flat", kSize, 1);
  CHECK(std::all_of(level.values.begin(), level.values.end(), [](float height) { return height == 0; }));
}

// Every point of the bowl, its depth A = ¼ being a quarter of the width, is R from the centre of the sphere,
// which stands R above the lowest point. Rounding to float moves a height by at most 2⁻²⁵ A.
TEST_CASE("The bowl is a spherical cap at relief 0.25 of the width", "[synth]") {
  constexpr int kSize = 75;  // odd, so that one texel is the lowest point
  constexpr double kDepth = 0.25;
  constexpr double kRadius = (0.35 * 0.35 + kDepth * kDepth) / (2 * kDepth);
  const Image<float> bowl = synthesize("bowl", kSize, 1);
  CHECK(bowl(37, 37) == 0);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      CAPTURE(row, column);
      const double du = coordinate(column, kSize) - 0.5;
      const double dv = coordinate(row, kSize) - 0.5;
      if (du * du + dv * dv >= 0.35 * 0.35) {
        CHECK(bowl(row, column) == 1);
      } else {
        const double below_centre = kRadius - kDepth * static_cast<double>(bowl(row, column));
        CHECK(std::sqrt(du * du + dv * dv + below_centre * below_centre) ==
              Approx(kRadius).margin(1e-8).epsilon(0));
      }
    }
  }
}

// Four terms with the library's sine; both are good to a few ε of double, and the float's rounding of 2⁻²⁵
// dominates.
TEST_CASE("The sines are the sum of four waves", "[synth]") {
  constexpr int kSize = 53;
  constexpr double kTurn = 2 * std::numbers::pi;
  const Image<float> sines = synthesize("sines", kSize, 1);
  for (int row = 0; row < kSize; ++row) {
    for (int column = 0; column < kSize; ++column) {
      CAPTURE(row, column);
      const double u = coordinate(column, kSize);
      const double v = coordinate(row, kSize);
      const double s = std::sin(kTurn * (2 * u + v)) + 0.7 * std::sin(kTurn * (-3 * u + 4 * v) + 1.3) +
                       0.5 * std::sin(kTurn * (7 * u + 5 * v) + 0.4) +
                       0.3 * std::sin(kTurn * (-11 * u + 13 * v) + 2.1);
      CHECK(static_cast<double>(sines(row, column)) == Approx((s + 2.5) / 5).margin(3.1e-8).epsilon(0));
    }
  }
}

TEST_CASE("A shape or a size that cannot be made is refused with a message", "[synth]") {
  CHECK_THROWS_AS(synthesize("sphere", 64, 1), UsageError);
  CHECK_THROWS_WITH(synthesize("sphere", 64, 1),
                    Catch::Contains("'sphere'") && Catch::Contains("cobbles, brick"));
  CHECK_THROWS_AS(synthesize("", 64, 1), UsageError);
  CHECK_THROWS_AS(synthesize("flat", 0, 1), UsageError);
  CHECK_THROWS_AS(synthesize("flat", -5, 1), UsageError);
  CHECK_THROWS_WITH(synthesize("flat", 32769, 1), Catch::Contains("32769"));
}
