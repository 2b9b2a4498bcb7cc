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

/// A tree, and the mode to use it with.
struct EmbreeWay {
  std::shared_ptr<const EmbreeMesh> mesh;
  EmbreeMode mode;
  Cost built;
};

/// The best that Embree can do on a surface, the best by packets alone, and what they were chosen from.
struct EmbreeBest {
  EmbreeWay any;
  EmbreeWay packets;
  std::vector<EmbreeTree> trees;
};

constexpr int kEmbreeTrialRays = 256;  ///< per texel; about what the errors asked for need

/// Tries each tree with each mode on some rows of the map, and keeps the pairs that cost a whole map of
/// kEmbreeTrialRays the fewest core-seconds, the tree's own included.
EmbreeBest find_embree_best(const Surface& surface);

/// Sky view factor by the best, one method per density, and by the best packets. The surface must outlive
/// them.
std::vector<Method> embree_sky_methods(const Surface& surface, const EmbreeBest& best);

}  // namespace heightlight
