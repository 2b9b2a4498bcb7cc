#pragma once

#include <Eigen/Core>
#include <vector>

#include "heightlight/gloss.h"

// Lobes in the frame of a receiver's normal, which is z there.

namespace heightlight {

/// A direction of a lobe, and what it stands for.
struct LobeSample {
  Eigen::Vector3d direction;
  double weight = 0;  ///< of the lobe's light; 0 for directions below the surface
};

/// f_r cosθ of GGX, 1/sr: light from `light` that goes to `view`, both unit, with z > 0.
double ggx_lobe(const Gloss& gloss, const Eigen::Vector3d& view, const Eigen::Vector3d& light);

/// Where a lattice of samples begins, in [0, 1) each.
struct LatticeShift {
  double u = 0;
  double v = 0;
};

/// `count` directions into which GGX sends what comes from `view`, by visible normals (Heitz 2018): Σ weight
/// g(direction)/count is an unbiased ∫ g f_r cosθ dω. Replaces what `samples` holds.
void sample_ggx(const Gloss& gloss, const Eigen::Vector3d& view, int count, const LatticeShift& shift,
                std::vector<LobeSample>& samples);

/// The same of Lambert's lobe, cosθ/π.
void sample_lambert(int count, const LatticeShift& shift, std::vector<LobeSample>& samples);

}  // namespace heightlight
