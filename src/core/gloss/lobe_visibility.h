#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "gloss/ggx_lobe.h"
#include "heightlight/gloss.h"
#include "visibility/exact_walk.h"
#include "visibility/ray_caster.h"

namespace heightlight {

/// The share of a receiver's lobe that sees the sky.
struct LobeShare {
  double open = 1;   ///< S; NaN where the receiver is missing or faces away
  double error = 0;  ///< standard error of `open`
};

/// Draws samples of a lobe in the receiver's own frame, where `view` is a unit vector with z > 0.
using LobeSampler = std::function<void(const Eigen::Vector3d& view, int count, const LatticeShift& shift,
                                       std::vector<LobeSample>& samples)>;
LobeSampler ggx_sampler(const Gloss& gloss);
LobeSampler lambert_sampler();

/// A lobe whose visibility is wanted.
struct LookedLobe {
  LobeSampler sampler;
  Eigen::Vector3d view = Eigen::Vector3d::UnitZ();  ///< toward the viewer; unit, world axes
  int rays = 256;                                   ///< at least kLobeParts
  std::uint64_t seed = 1;
};

/// Number of parts that a receiver's rays are divided into. Each part is a lattice with a random shift of its
/// own, so that the differences between parts show the error of their mean. This estimate is too high, if
/// anything, as the mean over a texel's neighbours is better.
constexpr int kLobeParts = 16;

/// Buffers that one thread reuses for all its receivers. `most_rays` is the largest number of rays of any
/// lobe.
struct LobeWorkspace {
  explicit LobeWorkspace(int most_rays) : rays(most_rays) {}

  RayWorkspace rays;
  std::vector<LobeSample> part;
  std::vector<double> weights;
  std::vector<Eigen::Vector3f> directions;
  std::vector<char> open;
};

/// Finds the visible share by rays; `caster` must have been made for at least as many rays as the lobe has.
LobeShare look_by_rays(const RayCaster& caster, const Surface& surface, int row, int column,
                       const LookedLobe& lobe, LobeWorkspace& work);

/// As look_by_rays, but compares each direction with the exact horizon of its own azimuth: slow, and
/// independent of rays.
LobeShare look_by_horizons(const ExactWalker& walker, int row, int column, const LookedLobe& lobe,
                           LobeWorkspace& work);

}  // namespace heightlight
