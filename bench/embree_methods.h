#pragma once

#include <memory>
#include <vector>

#include "embree_rays.h"
#include "method.h"

namespace heightlight {

/// All modes in which Embree can be asked for occlusion.
std::vector<EmbreeMode> embree_modes();

/// One of Embree's trees over a surface, and the speed of each mode with it.
struct EmbreeTree {
  EmbreePrimitive primitive = EmbreePrimitive::quad;
  RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
  Cost built;
  std::vector<double> ray_core_ns;  ///< core-nanoseconds per ray, in the order of embree_modes()
};

/// A tree, and the mode to use it with.
struct EmbreeWay {
  std::shared_ptr<const EmbreeMesh> mesh;
  EmbreeMode mode;
  Cost built;
};

/// Embree's best tree and mode on a surface, its best by packets alone, and all trees that were tried.
struct EmbreeBest {
  EmbreeWay any;
  EmbreeWay packets;
  std::vector<EmbreeTree> trees;
};

constexpr int kEmbreeTrialRays = 256;  ///< per texel; about as many as the targets for the error need

/// Tries each tree with each mode on some rows of the map, and keeps the pairs that need the fewest
/// core-seconds for a whole map with kEmbreeTrialRays per texel, including the time to build the tree.
EmbreeBest find_embree_best(const Surface& surface);

/// Methods for the sky view factor: the best tree and mode with each ray density, and the best packets. The
/// surface must outlive them.
std::vector<Method> embree_sky_methods(const Surface& surface, const EmbreeBest& best);

}  // namespace heightlight
