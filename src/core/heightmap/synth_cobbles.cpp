#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "heightmap/synth_noise.h"
#include "heightmap/synth_shapes.h"

// Rounded stones: the cells of a power diagram (a Voronoi diagram with weights) about jittered centres, with
// rounded corners. Lengths are in map widths, heights are shares of the relief.

namespace heightlight::synth {
namespace {

constexpr int kRows = 8;
constexpr int kColumns = 8;
constexpr int kWindow = 2;  // stones up to so many cells away can touch a stone
constexpr int kNeighbours = (2 * kWindow + 1) * (2 * kWindow + 1) - 1;

struct Centre {
  double u, v;
  double weight;  // weight in the power diagram, length²
};

/// A border with a neighbour. The distance from it is offset + slope · (position − centre).
struct Border {
  double slope_u, slope_v, offset;
};

struct Stone {
  Centre centre;
  std::array<Border, kNeighbours> borders;
  double top;
  double tilt_u, tilt_v;
  double shift_u, shift_v;  // shift of the noise fields
  double shoulder;          // how far in from its outline the stone is rounded
  double drop;              // height lost over the shoulder
  double roughness;
};

int wrapped(int i, int period) { return (i % period + period) % period; }

// Centre of a stone. It may lie outside [0, 1): neighbours across the map's edge are copies one period away.
Centre centre_of(int row, int column, std::uint64_t seed) {
  RandomSequence random(hash_cell(wrapped(column, kColumns), wrapped(row, kRows), seed));
  const double bond = wrapped(row, 2) == 0 ? 0.25 : 0.75;
  const double u = (column + bond + random.between(-0.2, 0.2)) / kColumns;
  const double v = (row + 0.5 + random.between(-0.17, 0.17)) / kRows;
  return {u, v, random.between(0, 0.004)};
}

Stone lay_stone(int row, int column, std::uint64_t seed) {
  Stone stone{};
  stone.centre = centre_of(row, column, seed);
  std::size_t i = 0;
  for (int y = -kWindow; y <= kWindow; ++y) {
    for (int x = -kWindow; x <= kWindow; ++x) {
      if (x == 0 && y == 0) continue;
      const Centre other = centre_of(row + y, column + x, seed);
      const double du = other.u - stone.centre.u;
      const double dv = other.v - stone.centre.v;
      const double apart = std::sqrt(du * du + dv * dv);
      const double offset = (apart * apart + stone.centre.weight - other.weight) / (2 * apart);
      stone.borders[i++] = {-du / apart, -dv / apart, offset};
    }
  }
  RandomSequence random(hash_cell(column, row, scramble(seed)));
  stone.top = random.between(0.76, 0.98);
  stone.tilt_u = random.between(-1.1, 1.1);
  stone.tilt_v = random.between(-1.1, 1.1);
  stone.shift_u = random.unit();
  stone.shift_v = random.unit();
  stone.shoulder = random.between(0.03, 0.05);
  stone.drop = random.between(0.3, 0.5);
  stone.roughness = random.between(0.5, 1.5);
  return stone;
}

class Paving {
 public:
  Paving(int size, std::uint64_t seed);
  double height(double u, double v) const;

 private:
  const Stone& stone_at(double u, double v) const;
  double face(const Stone& stone, double du, double dv, double inside) const;
  double bedding(double u, double v) const;

  std::vector<Stone> stones_;
  Octaves outline_u_, outline_v_;
  Octaves lumps_;
  Octaves grain_;
  Spots pits_;
  Octaves filling_;
  Octaves sand_;
  Spots gravel_;
};

Paving::Paving(int size, std::uint64_t seed)
    : outline_u_(9, 150, 0.5, hash_combine(seed, 31)),
      outline_v_(9, 150, 0.5, hash_combine(seed, 32)),
      lumps_(11, 44, 0.5, hash_combine(seed, 33)),
      grain_(60, size / 2, 0.62, hash_combine(seed, 34)),
      pits_(53, 0.12, 0.1, 0.35, hash_combine(seed, 35)),
      filling_(6, 24, 0.6, hash_combine(seed, 36)),
      sand_(70, size / 2, 0.75, hash_combine(seed, 37)),
      gravel_(70, 0.3, 0.2, 0.5, hash_combine(seed, 38)) {
  const std::uint64_t stone_seed = hash_combine(seed, 30);
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) stones_.push_back(lay_stone(row, column, stone_seed));
  }
}

// The cell of the power diagram that holds the point.
const Stone& Paving::stone_at(double u, double v) const {
  const int row = floor_to_int(v * kRows);
  const int column = floor_to_int(u * kColumns);
  const Stone* nearest = stones_.data();
  double least = 10;
  for (int y = row - kWindow; y <= row + kWindow; ++y) {
    for (int x = column - kWindow; x <= column + kWindow; ++x) {
      const Stone& stone =
          stones_[static_cast<std::size_t>(wrapped(y, kRows) * kColumns + wrapped(x, kColumns))];
      const double du = shorter_way(u - stone.centre.u);
      const double dv = shorter_way(v - stone.centre.v);
      const double power = du * du + dv * dv - stone.centre.weight;
      if (power < least) {
        least = power;
        nearest = &stone;
      }
    }
  }
  return *nearest;
}

// Height of a stone: a worn top with a shoulder rounded like a quarter ellipse; beyond the outline it falls
// steeply.
double Paving::face(const Stone& stone, double du, double dv, double inside) const {
  const double u = stone.centre.u + du + stone.shift_u;
  const double v = stone.centre.v + dv + stone.shift_v;
  double h = stone.top + stone.tilt_u * du + stone.tilt_v * dv;
  h += stone.roughness * (0.05 * lumps_(u, v) + 0.022 * grain_(u, v));
  const Spot pit = pits_(u, v);
  if (pit.distance < 1) h -= (0.03 + 0.1 * pit.chance) * (1 - pit.distance * pit.distance);
  if (inside >= stone.shoulder) return h;
  const double over = inside > 0 ? 1 - inside / stone.shoulder : 1;
  h -= stone.drop * (1 - std::sqrt(1 - over * over));
  return inside < 0 ? h + 120 * inside : h;
}

// Sand, washed out in places, with small gravel.
double Paving::bedding(double u, double v) const {
  double h = 0.02 + 0.42 * smoothstep(-0.5, 0.6, filling_(u, v)) + 0.035 * sand_(u, v);
  const Spot pebble = gravel_(u, v);
  if (pebble.distance < 1) h += 0.05 * std::sqrt(1 - pebble.distance * pebble.distance);
  return h;
}

double Paving::height(double u, double v) const {
  const double warped_u = u + 0.008 * outline_u_(u, v);
  const double warped_v = v + 0.008 * outline_v_(u, v);
  const Stone& stone = stone_at(warped_u, warped_v);
  const double du = shorter_way(warped_u - stone.centre.u);
  const double dv = shorter_way(warped_v - stone.centre.v);
  // Summing inverse squares rounds the corners where borders meet.
  double sum = 0;
  for (const Border& border : stone.borders) {
    const double distance = std::max(1e-4, border.offset + border.slope_u * du + border.slope_v * dv);
    sum += 1 / (distance * distance);
  }
  const double inside = 1.8 / std::sqrt(sum) - 0.013;
  const double ground = bedding(u, v);
  return smooth_max(ground, face(stone, du, dv, inside), 0.04);
}

}  // namespace

Image<float> cobbles(int size, std::uint64_t seed) {
  const Paving paving(size, seed);
  return sample(size, [&](double u, double v) { return paving.height(u, v); });
}

}  // namespace heightlight::synth
