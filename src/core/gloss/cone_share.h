#pragma once

#include <vector>

#include "gloss/ggx_lobe.h"
#include "heightlight/gloss.h"

namespace heightlight {

/// Samples of a lobe that many cones are compared with: directions in the plane of the normal and the
/// mirrored view, x along the tangent of the mirrored view, and their weights.
struct ConeLobe {
  static constexpr std::size_t kLanes = 8;

  std::vector<float> x, z, weight;  ///< padded to whole lanes with weights of 0
  float whole = 0;                  ///< sum of weights
};

/// Makes a lobe of `count` samples, seen at `view_angle` from the normal, radians.
ConeLobe make_cone_lobe(const Gloss& gloss, double view_angle, int count, const LatticeShift& shift);

/// Eq. 30 of Jimenez 2016: the share of the lobe inside the cone. The lobe must have the roughness and the
/// view of the arguments.
double cone_share(const ConeLobe& lobe, const ConeArguments& arguments);

}  // namespace heightlight
