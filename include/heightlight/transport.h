#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/visibility.h"

namespace heightlight {

/// One value per texel in row-major order, in the precision that sums are made with; 0 where the sample is
/// missing.
using TexelVector = Eigen::VectorXd;

/// What a receiver sees along one ray: a place on the surface, and through `ray` the form factor. The place
/// lies in the cell whose upper left vertex is (row, column), at (across, down) / 255 of it.
struct Link {
  std::uint32_t cell = 0;  ///< row × (width + 1) + column: an index into values padded by a column and a row
  std::uint16_t ray = 0;
  std::uint8_t across = 0;
  std::uint8_t down = 0;
};
static_assert(sizeof(Link) == 8);

/// The links of one row of receivers; receiver j's are links[begin[j]] … links[begin[j + 1]].
struct LinkRow {
  std::vector<std::uint64_t> begin;
  std::vector<std::uint8_t> weight_table;  ///< per receiver: which of FormFactors::ray_weights its rays use
  std::vector<Link> links;
};

/// The operator F that carries irradiance from bounce to bounce, and the sky's share of every receiver:
/// sky_view_factor_i + Σ_j F_ij = 1.
struct FormFactors {
  int width = 0;
  int height = 0;
  Map ambient_occlusion;  ///< α: share of the hemisphere's solid angle that sees the sky, [0, 1]
  Map sky_view_factor;    ///< A: the same, cosine weighted; NaN where the sample is missing, in both
  TexelVector
      direct;  ///< E₀/π: A in full precision, 0 where missing; 1 − Σ_j F_ij to the last bit that counts
  std::vector<std::vector<double>> ray_weights;  ///< form factor of each ray, per table
  std::vector<LinkRow> rows;

  std::uint64_t link_count() const;
  std::uint64_t bytes() const;
};

/// What finding the form factors may use, and whom to tell how far it is.
struct FormFactorOptions {
  RayOptions rays;
  std::uint64_t memory_limit = ~0ULL;  ///< bytes for the links
  bool quiet = true;                   ///< no progress bar
  std::string map_name = "the map";    ///< for messages
};

/// Casts rays from every receiver and stores what they see. The bytes are estimated from a sample of
/// receivers first. Throws Error when they pass `memory_limit`, UsageError for a bad number of rays.
FormFactors build_form_factors(const Surface& surface, const FormFactorOptions& options);

/// F x: what each receiver gets when the surface's radiosity / π is x. Rows without links give 0.
TexelVector gather(const FormFactors& form_factors, const TexelVector& x);

/// Largest |sky_view_factor + Σ F − 1| over the receivers, the row sums made from the stored links.
double row_sum_error(const FormFactors& form_factors);

/// The solution x of x = source + F (ρ x), to a residual of 1e-8 of the source's norm, by BiCGSTAB; `guess`
/// is where it starts. `albedo` is ρ per texel, in [0, 1].
struct Equilibrium {
  TexelVector irradiance;
  int iterations = 0;
  double residual = 0;  ///< |source + F ρ x − x| / |source|
};
Equilibrium solve_equilibrium(const FormFactors& form_factors, const TexelVector& source,
                              const TexelVector& albedo, const TexelVector& guess, bool quiet = true);

/// Bounces at ρ = 1, from which those at any constant albedo follow: E_b(ρ) = ρ^b E_b. All values are E/π.
struct BounceSeries {
  int bounces = 0;                    ///< K: the last one
  TexelVector sum;                    ///< E₀ + … + E_K
  std::vector<TexelVector> weighted;  ///< Σ_{b ≤ K} ρ^b E_b, per albedo asked for
  TexelVector next;                   ///< E_{K+1} = F E_K
  double spectral_radius = 0;  ///< of F, by the Rayleigh quotient of E_K: a lower bound that E_K makes tight
};

/// Computes E_0 … E_K and hands each to `visit(b, E_b)` as it is made. Texels weigh 1/n_z, their area, in the
/// Rayleigh quotient, under which F is symmetric.
BounceSeries bounce(const FormFactors& form_factors, const Surface& surface, int bounces,
                    const std::vector<double>& albedos,
                    const std::function<void(int, const TexelVector&)>& visit, bool quiet);

/// What all bounces after the K-th bring at constant albedo ρ: ρ^{K+1} t, with t = E_{K+1} + ρ F t.
Equilibrium solve_tail(const FormFactors& form_factors, const BounceSeries& series, double albedo,
                       bool quiet = true);

/// Values as a map, NaN where the surface has no receiver.
Map to_map(const TexelVector& values, const Surface& surface);

}  // namespace heightlight
