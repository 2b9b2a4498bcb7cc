#pragma once

#include <memory>
#include <vector>

#include "embree_rays.h"
#include "method.h"

namespace heightlight {

/// Every way to ask Embree for occlusion.
std::vector<EmbreeMode> embree_modes();

/// One of Embree's trees over a surface, and how fast each mode is with it.
struct EmbreeTree {
  EmbreePrimitive primitive = EmbreePrimitive::quad;
  RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
  Cost built;
  std::vector<double> ray_core_ns;  ///< per ray, by embree_modes()
};

/// The best that Embree can do on a surface, and what it was chosen from.
struct EmbreeBest {
  std::shared_ptr<const EmbreeMesh> mesh;
  EmbreeMode mode;
  Cost built;
  std::vector<EmbreeTree> trees;
};

constexpr int kEmbreeTrialRays = 256;  ///< per texel; about what the errors asked for need

/// Tries each tree with each mode on some rows of the map, and keeps the pair that costs a whole map of
/// kEmbreeTrialRays the fewest core-seconds, the tree's own included.
EmbreeBest find_embree_best(const Surface& surface);

/// Sky view factor by the best, one method per density. The surface must outlive them.
std::vector<Method> embree_sky_methods(const Surface& surface, const EmbreeBest& best);

}  // namespace heightlight
