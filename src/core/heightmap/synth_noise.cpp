#include "heightmap/synth_noise.h"

#include <cmath>

namespace heightlight::synth {
namespace {

// The cell within the period. Cells are a few periods outside at most, so this is cheaper than a division.
int wrap(int cell, int period) {
  while (cell < 0) cell += period;
  while (cell >= period) cell -= period;
  return cell;
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// Dot product of the lattice point's gradient, uniform in a square, and the offset from the point.
double slope(std::uint64_t hash, double x, double y) {
  const double gradient_x = static_cast<std::int32_t>(hash >> 32) * 0x1p-31;
  const double gradient_y = static_cast<std::int32_t>(hash & 0xffffffffU) * 0x1p-31;
  return gradient_x * x + gradient_y * y;
}

double mixed(double a, double b, double t) { return a + (b - a) * t; }

}  // namespace

TiledNoise::TiledNoise(int frequency_x, int frequency_y, std::uint64_t seed)
    : frequency_x_(frequency_x),
      frequency_y_(frequency_y),
      shift_x_(unit_real(hash_combine(seed, 1))),
      shift_y_(unit_real(hash_combine(seed, 2))),
      seed_(seed) {}

double TiledNoise::operator()(double u, double v) const {
  constexpr double kToUsualDeviation = 1.6;
  const double x = u * frequency_x_ + shift_x_;
  const double y = v * frequency_y_ + shift_y_;
  const int cell_x = floor_to_int(x);
  const int cell_y = floor_to_int(y);
  const double dx = x - cell_x;
  const double dy = y - cell_y;
  const int x0 = wrap(cell_x, frequency_x_);
  const int y0 = wrap(cell_y, frequency_y_);
  const int x1 = x0 + 1 == frequency_x_ ? 0 : x0 + 1;
  const int y1 = y0 + 1 == frequency_y_ ? 0 : y0 + 1;
  const double fade_x = fade(dx);
  const double top =
      mixed(slope(hash_cell(x0, y0, seed_), dx, dy), slope(hash_cell(x1, y0, seed_), dx - 1, dy), fade_x);
  const double bottom = mixed(slope(hash_cell(x0, y1, seed_), dx, dy - 1),
                              slope(hash_cell(x1, y1, seed_), dx - 1, dy - 1), fade_x);
  return kToUsualDeviation * mixed(top, bottom, fade(dy));
}

Octaves::Octaves(int first, int last, double persistence, std::uint64_t seed) : persistence_(persistence) {
  int frequency = first;
  do {
    octaves_.emplace_back(frequency, frequency, hash_combine(seed, static_cast<std::uint64_t>(frequency)));
    frequency *= 2;
  } while (frequency <= last);
}

double Octaves::operator()(double u, double v) const {
  double sum = 0;
  double amplitude = 1;
  for (const TiledNoise& octave : octaves_) {
    sum += amplitude * octave(u, v);
    amplitude *= persistence_;
  }
  return sum;
}

Spots::Spots(int frequency, double coverage, double smallest, double largest, std::uint64_t seed)
    : frequency_(frequency), coverage_(coverage), smallest_(smallest), largest_(largest), seed_(seed) {}

Spot Spots::operator()(double u, double v) const {
  const double x = u * frequency_;
  const double y = v * frequency_;
  const int cell_x = floor_to_int(x);
  const int cell_y = floor_to_int(y);
  RandomSequence random(hash_cell(wrap(cell_x, frequency_), wrap(cell_y, frequency_), seed_));
  if (random.unit() >= coverage_) return {};
  const double share = random.unit();
  const double radius = smallest_ + (largest_ - smallest_) * share * share;
  const double dx = x - cell_x - random.between(radius, 1 - radius);
  const double dy = y - cell_y - random.between(radius, 1 - radius);
  return {std::sqrt(dx * dx + dy * dy) / radius, random.unit()};
}

}  // namespace heightlight::synth
