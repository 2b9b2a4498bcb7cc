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

/// What a receiver's lobe sees of the sky.
struct LobeShare {
  double open = 1;   ///< S; NaN where the receiver is missing or faces away
  double error = 0;  ///< standard error
};

/// A lobe of samples in the receiver's own frame, where `view` is a unit vector with z > 0.
using LobeSampler = std::function<void(const Eigen::Vector3d& view, int count, const LatticeShift& shift,
                                       std::vector<LobeSample>& samples)>;
LobeSampler ggx_sampler(const Gloss& gloss);
LobeSampler lambert_sampler();

/// A lobe that is looked along.
struct LookedLobe {
  LobeSampler sampler;
  Eigen::Vector3d view = Eigen::Vector3d::UnitZ();  ///< unit, world axes
  int rays = 256;                                   ///< at least kLobeParts
  std::uint64_t seed = 1;
};

/// Parts that a receiver's rays are in. Each is a lattice with a random shift of its own, so that how they
/// differ tells the error of their mean: too high, if anything, as the mean over a texel's neighbours is
/// better.
constexpr int kLobeParts = 16;

/// Buffers that one thread reuses from receiver to receiver; of as many rays as any of its lobes has.
struct LobeWorkspace {
  explicit LobeWorkspace(int most_rays) : rays(most_rays) {}

  RayWorkspace rays;
  std::vector<LobeSample> part;
  std::vector<double> weights;
  std::vector<Eigen::Vector3f> directions;
  std::vector<char> open;
};

/// By rays; `caster` was made for at least as many as the lobe has.
LobeShare look_by_rays(const RayCaster& caster, const Surface& surface, int row, int column,
                       const LookedLobe& lobe, LobeWorkspace& work);

/// The same directions, each against the exact horizon of its own azimuth: slow, and independent of rays.
LobeShare look_by_horizons(const ExactWalker& walker, int row, int column, const LookedLobe& lobe,
                           LobeWorkspace& work);

}  // namespace heightlight
