#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {

/// Texels that a study shades.
struct ReceiverGrid {
  int columns = 0;
  int rows = 0;
  std::vector<std::size_t> texels = {};  ///< row by row; of a map's texels
};

/// One of every cell of a grid over the map, picked by a hash, so that they miss no pattern; as many as make
/// no side longer than `most`.
ReceiverGrid pick_receiver_grid(const Surface& surface, int most, std::uint64_t seed);

/// All texels of a window in the map's middle, no side of which is longer than `most`: for pictures.
ReceiverGrid pick_receiver_window(const Surface& surface, int most);

/// What a shader is told of a texel.
struct Openness {
  double sky_view_factor = 1;  ///< A; NaN where the sample is missing
  Eigen::Vector3d bent_normal = Eigen::Vector3d::UnitZ();
  /// Of the cone whose directions are spread as much (bent_cone.h), rad; NaN where that is not known.
  double spread_half_angle = std::numeric_limits<double>::quiet_NaN();
};

/// Of all receivers, as one way of finding it has it.
struct OpennessSource {
  std::string name = {};
  std::vector<Openness> receivers = {};
  std::vector<Harmonics> harmonics = {};  ///< as `sh` maps hold them; empty where none are found
};

/// Names of ways.
inline constexpr const char* kExactOpenness = "exact";
inline constexpr const char* kBakedOpenness = "baked";
inline constexpr const char* kGtaoOpenness = "GTAO";

/// Azimuths of exact horizons that openness is found by.
constexpr int kOpennessAzimuths = 256;

/// By exact horizons.
OpennessSource find_exact_openness(const Surface& surface, const ReceiverGrid& grid, const Watch& watch);

/// The same; as `bake` finds it at its default error; by GTAO as games run it, three slices of three
/// steps a side that reach as far as the relief is high. Throws what solve throws, which may take so many
/// bytes.
std::vector<OpennessSource> find_openness(const Surface& surface, const ReceiverGrid& grid,
                                          std::uint64_t memory, const Watch& watch);

/// Unit normal of a texel.
Eigen::Vector3d normal_at(const Surface& surface, std::size_t texel);

}  // namespace heightlight
