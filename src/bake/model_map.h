#pragma once

#include <vector>

#include "heightlight/transport.h"

namespace heightlight {

// The closed form G(A, n, ρ) = A + ρ (1 − A) n/(1 − ρ (1 − n)), E/π at any albedo, is exact at ρ = 0 and 1
// whatever n is: the mean of A in what a texel sees, if all that it sees were alike. Two channels, A and n
// with n fitted to the simulation at one albedo, thus hold the bounces of all.

/// Where n is fitted.
constexpr double kFittedAlbedo = 0.8;

/// Where the errors of the fit are measured, with kFittedAlbedo among them.
const std::vector<double>& judged_albedos();

/// n in [0, 1] from A and the simulated total E/π at albedo ρ in (0, 1): with q = (E/π − A)/(1 − A), q (1 −
/// ρ)/(ρ (1 − q)). 1 where all is open.
double fit_model_n(double sky_view_factor, double total, double albedo);

double evaluate_model(double sky_view_factor, double n, double albedo);

/// RMS over the receivers of G less the simulation, with A and n as they are and rounded to 16 and 8 bits.
struct ModelError {
  double albedo = 0;
  double rmse = 0;
  double rmse_16_bits = 0;
  double rmse_8_bits = 0;
};

/// n of every texel, NaN where the sample is missing; `total` is E/π at kFittedAlbedo.
Map fit_model_map(const Map& sky_view_factor, const TexelVector& total);

ModelError judge_model_map(const Map& sky_view_factor, const Map& n, const TexelVector& total, double albedo);

/// The function that turns the two channels into E/π, for shaders.
const char* model_shader_glsl();
const char* model_shader_hlsl();

}  // namespace heightlight
