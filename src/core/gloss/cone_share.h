#pragma once

#include <vector>

#include "gloss/ggx_lobe.h"
#include "heightlight/gloss.h"

namespace heightlight {

/// A lobe as many cones are held against: its directions in the plane of normal and mirrored view, x along
/// the view's mirrored tangent, and what they stand for.
struct ConeLobe {
  static constexpr std::size_t kLanes = 8;

  std::vector<float> x, z, weight;  ///< padded to whole lanes with weights of 0
  float whole = 0;                  ///< sum of weights
};

/// Of `count` samples.
ConeLobe make_cone_lobe(const Gloss& gloss, double view_angle, int count, const LatticeShift& shift);

/// Eq. 30 of Jimenez 2016: the share of the lobe inside the cone. The lobe is that of the arguments'
/// roughness and view.
double cone_share(const ConeLobe& lobe, const ConeArguments& arguments);

}  // namespace heightlight
