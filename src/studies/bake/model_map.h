#pragma once

#include <vector>

#include "heightlight/image.h"

namespace heightlight {

// The closed form G(A, n, ρ) of forms.h (bounced_total) is exact at ρ = 0 and 1 whatever n is. Two channels,
// A and the n that makes it exact at one more albedo, thus hold the bounces of all.

/// Where the errors of the fit are measured, with kSeenAlbedo, where n is solved for, among them.
const std::vector<double>& checked_albedos();

/// RMS over the receivers of G less the simulation, with A and n as they are and rounded to 16 and 8 bits.
struct ModelError {
  double albedo = 0;
  double rmse = 0;
  double rmse_16_bits = 0;
  double rmse_8_bits = 0;
};

ModelError judge_model_map(const Map& sky_view_factor, const Map& n, const TexelVector& total, double albedo);

}  // namespace heightlight
