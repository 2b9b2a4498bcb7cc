#include "visibility/hemisphere_directions.h"

#include <cmath>
#include <numbers>

#include "base/hash.h"

namespace heightlight {

LatticeTurn HemisphereDirections::turn(int row, int column) const {
  const std::uint64_t texel = static_cast<std::uint64_t>(row % kTile * kTile + column % kTile);
  const std::uint64_t hash = hash_combine(seed, texel);
  const double angle = 2 * std::numbers::pi * unit_real(hash);
  return {static_cast<int>(hash % kTables), static_cast<float>(std::cos(angle)),
          static_cast<float>(std::sin(angle))};
}

HemisphereDirections make_hemisphere_directions(int count, std::uint64_t seed) {
  HemisphereDirections directions;
  directions.count = count;
  directions.seed = seed;
  const auto n = static_cast<std::size_t>(count);
  directions.azimuth_cosine.resize(n);
  directions.azimuth_sine.resize(n);
  for (int k = 0; k < count; ++k) {
    const double turns = k * (std::numbers::phi - 1);
    const double azimuth = 2 * std::numbers::pi * (turns - std::floor(turns));
    directions.azimuth_cosine[static_cast<std::size_t>(k)] = static_cast<float>(std::cos(azimuth));
    directions.azimuth_sine[static_cast<std::size_t>(k)] = static_cast<float>(std::sin(azimuth));
  }
  for (int table = 0; table < HemisphereDirections::kTables; ++table) {
    const auto t = static_cast<std::size_t>(table);
    directions.cosine[t].resize(n);
    directions.sine[t].resize(n);
    directions.weight[t].resize(n);
    const double offset = (table + 0.5) / HemisphereDirections::kTables;
    const double cosine_sum = count - (0.5 * (count - 1) + offset);  // Σ (1 − (k + o)/N)
    for (int k = 0; k < count; ++k) {
      const double cosine = 1 - (k + offset) / count;
      directions.cosine[t][static_cast<std::size_t>(k)] = static_cast<float>(cosine);
      directions.sine[t][static_cast<std::size_t>(k)] = static_cast<float>(std::sqrt(1 - cosine * cosine));
      directions.weight[t][static_cast<std::size_t>(k)] = cosine / cosine_sum;
    }
  }
  return directions;
}

}  // namespace heightlight
