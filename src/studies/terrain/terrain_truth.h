#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "terrain/terrain_quantities.h"

namespace heightlight {

/// Exact horizons along so many azimuths stand for the truth.
inline constexpr int kTruthAzimuths = 256;

/// Receivers at most.
inline constexpr int kTruthReceivers = 4096;

/// What methods are compared with, on some receivers.
struct TerrainTruth {
  std::vector<std::size_t> receivers;       ///< texels that are present, rising, none twice
  std::vector<std::vector<double>> values;  ///< per quantity, in the order of terrain_quantities()

  const std::vector<double>& of(const TerrainQuantity& quantity) const;
};

/// All texels that are present where they are few, else a sample by a hash of `seed`.
std::vector<std::size_t> pick_receivers(const Surface& surface, int most, std::uint64_t seed);

/// A quantity of each receiver, from exact horizons along φ_k = 2π (k + ¼)/azimuths.
std::vector<double> find_exactly(const Surface& surface, int azimuths,
                                 const std::vector<std::size_t>& receivers, const TerrainQuantity& quantity,
                                 const Watch& watch = {});

TerrainTruth find_terrain_truth(const Surface& surface, std::uint64_t seed, const Watch& watch = {});

}  // namespace heightlight
