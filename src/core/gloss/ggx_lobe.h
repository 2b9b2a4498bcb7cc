#pragma once

#include <Eigen/Core>
#include <vector>

#include "heightlight/gloss.h"

// Lobes in the frame of a receiver's normal, which is z there.

namespace heightlight {

/// A direction of a lobe, and its weight.
struct LobeSample {
  Eigen::Vector3d direction;
  double weight = 0;  ///< weight in the mean over the samples; 0 for directions below the surface
};

/// f_r cosθ of GGX, 1/sr, from the direction `light` to the direction `view`; both unit, with z > 0.
double ggx_lobe(const Gloss& gloss, const Eigen::Vector3d& view, const Eigen::Vector3d& light);

/// Start of a lattice of samples, in [0, 1) each.
struct LatticeShift {
  double u = 0;
  double v = 0;
};

/// Draws `count` directions into which GGX reflects what comes from `view`, by visible normals (Heitz 2018):
/// Σ weight g(direction)/count is an unbiased estimate of ∫ g f_r cosθ dω. Replaces the content of `samples`.
void sample_ggx(const Gloss& gloss, const Eigen::Vector3d& view, int count, const LatticeShift& shift,
                std::vector<LobeSample>& samples);

/// As sample_ggx, for Lambert's lobe, cosθ/π.
void sample_lambert(int count, const LatticeShift& shift, std::vector<LobeSample>& samples);

}  // namespace heightlight
