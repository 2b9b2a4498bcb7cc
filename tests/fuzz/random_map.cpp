#include "random_map.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "base/hash.h"

namespace heightlight {
namespace {

/// One random number after the other.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(scramble(seed)) {}
  double unit() { return unit_real(state_ = scramble(state_)); }
  int below(int count) { return static_cast<int>(unit() * count); }
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::uint64_t state_;
};

constexpr std::array kKinds{"rough", "terraced", "level", "spiked", "pitted", "walled", "smooth"};

/// Height of a texel in [0, 1].
double height_of(int kind, double x, double y, Dice& dice) {
  const double noise = dice.unit();
  switch (kind) {
    case 0:
      return noise;
    case 1:
      return std::floor(noise * 4) / 4;
    case 2:
      return 0.5;
    case 3:
      return noise < 0.1 ? 1 : 0;
    case 4:
      return noise < 0.1 ? 0 : 1;
    case 5:
      return x < 0.5 ? 0.1 * noise : 1;
    default:
      return 0.5 + 0.25 * std::sin(2 * std::numbers::pi * (2 * x + y)) +
             0.25 * std::cos(2 * std::numbers::pi * (3 * y - x));
  }
}

int random_side(Dice& dice) {
  constexpr std::array kSides{1, 2, 3, 4, 5, 7, 8, 9, 11};
  return kSides[static_cast<std::size_t>(dice.below(kSides.size()))];
}

}  // namespace

RandomMap make_random_map(std::uint64_t seed) {
  Dice dice(seed);
  RandomMap result;
  Heightmap& map = result.map;
  const int width = random_side(dice);
  const int height = random_side(dice);
  const int kind = dice.below(kKinds.size());
  const double relief = std::pow(10, dice.between(-3, 2));
  const double missing_share = dice.unit() < 0.3 ? dice.between(0, 0.9) : 0;
  map.boundary = dice.unit() < 0.5 ? Boundary::tile : Boundary::open;
  map.spacing.x = 1.0 / width;
  map.spacing.y = dice.unit() < 0.3 ? map.spacing.x * dice.between(0.3, 3) : map.spacing.x;
  map.height = Image<float>(width, height);
  const int present = dice.below(width * height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      const double unit = height_of(kind, double(column) / width, double(row) / height, dice);
      const bool missing = dice.unit() < missing_share && row * width + column != present;
      map.height(row, column) =
          missing ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(relief * unit);
    }
  }
  char text[200];
  std::snprintf(text, sizeof text, "%s, %d x %d, relief %.3g, spacing y/x %.3g, %s, %.0f %% missing",
                kKinds[static_cast<std::size_t>(kind)], width, height, relief, map.spacing.y / map.spacing.x,
                to_string(map.boundary), 100 * missing_share);
  result.description = text;
  return result;
}

}  // namespace heightlight
