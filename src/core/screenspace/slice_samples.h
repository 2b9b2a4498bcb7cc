#pragma once

#include <array>
#include <vector>

#include "heightlight/screenspace.h"

// Where the receivers of a slice-based method look. The places relative to the texel are the same for every
// texel, except for the noise, which repeats every four texels: at most sixteen tables serve a whole map.
//
// Slice s of S has the azimuth φ = π (s + f)/S, counterclockwise from x. Without noise f = ¼, so that a
// feature mirrored by an axis is not seen twice at the same angle. The spatial noise turns the texel of rank
// r in its 4 × 4 square by f = (r + ¼)/16: the square has 16 S equidistant slices. Frame m of six turns it by
// f = (r + (m + ¼)/6)/16: 96 S equidistant slices in all. (Six turns by multiples of 60° would not do: modulo
// the 1/16 of the spatial noise they are only three.)

namespace heightlight {

/// Receivers that a kernel may walk at once, at most: buffers are padded for this number.
constexpr int kMostReceivers = 32;

constexpr int kNoiseSide = 4;
constexpr int kNoiseRanks = kNoiseSide * kNoiseSide;
constexpr int kFrames = 6;

/// Rank of a texel's direction in its 4 × 4 square. Every square of 4 × 4 texels, wherever it lies, contains
/// all ranks.
constexpr int noise_rank(int row, int column) {
  return (row + column) % kNoiseSide * kNoiseSide + column % kNoiseSide;
}

/// A texel to read: row and column relative to the receiver's, wrapped around the torus so that neither is
/// negative; and its weight in the sample's height, divided by the sample's distance.
struct DepthTap {
  int row = 0;
  int column = 0;
  float weight = 0;
};

struct SliceSample {
  std::array<DepthTap, 3> taps;  ///< the first SliceTables::taps of them
  float distance = 0;            ///< horizontal distance from the receiver, world units
};

struct Slice {
  float x = 1;  ///< world direction of side 1; side 0 looks in the opposite direction
  float y = 0;
  std::array<std::vector<SliceSample>, 2> sides;  ///< samples by rising distance
};

struct SliceTables {
  int taps = 1;                        ///< texels per sample: 1, or 3 on the mesh
  std::vector<std::vector<Slice>> of;  ///< one table, or kNoiseRanks of them

  const std::vector<Slice>& table(int row, int phase) const {
    return of[of.size() == 1 ? 0 : static_cast<std::size_t>(noise_rank(row, phase))];
  }
};

/// Options that slice-based methods have in common.
struct SliceOptions {
  int slices = 1;
  int steps = 1;
  StepDistribution distribution = StepDistribution::quadratic;
  DepthSampling sampling = DepthSampling::nearest;
  DirectionNoise noise = DirectionNoise::none;
  double radius = 0;
};

/// Throws UsageError if an option is out of its range; the message names `method` and the option.
void check_slice_options(const char* method, const SliceOptions& options);

int frame_count(DirectionNoise noise);

/// The tables of one frame, 0 … frame_count − 1.
SliceTables make_slice_tables(const DepthBuffer& depth, const SliceOptions& options, int frame);

}  // namespace heightlight
