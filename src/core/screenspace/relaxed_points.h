#pragma once

#include <Eigen/Core>
#include <vector>

namespace heightlight {

/// `count` ≥ 1 points of the unit cube, spread as evenly as Lloyd's relaxation makes them (Umenhoffer et al.
/// 2009, section 4.1: a Poisson disc distribution); x is an angle and wraps around. The points of a count are
/// always the same and are computed once, as a renderer would have them in its code. Safe to call from many
/// threads.
const std::vector<Eigen::Vector3d>& relaxed_points(int count);

}  // namespace heightlight
