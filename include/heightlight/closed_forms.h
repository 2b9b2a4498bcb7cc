#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/curves.h"
#include "heightlight/forms.h"
#include "heightlight/image.h"
#include "heightlight/surface.h"

// The closed forms of forms.h as a list, and what maps tell them.

namespace heightlight {

/// Everything that a closed form may want to know of a texel.
struct ModelInputs {
  AmbientOcclusion<double> ambient_occlusion{0};
  SkyViewFactor<double> sky_view_factor{0};
  SeenSkyViewFactor<double> expected_seen{0};  ///< s, one number per map
  SeenSkyViewFactor<double> deep_seen{0};      ///< t, one number per map
  SeenSkyViewFactor<double> blurred{0};        ///< W, the blurred sky view factor
  SeenSkyViewFactor<double> seen{0};           ///< n, stored as a second channel
};

/// What a closed form needs beside its AO.
enum class ExtraInput { none, expected_seen, deep_seen, blurred, seen };

/// One closed form of the list.
struct ClosedForm {
  std::string name;         ///< as in tables, snake_case
  std::string description;  ///< the formula
  std::string source;       ///< seed file and equation, or "here"
  AoKind kind = AoKind::sky_view_factor;
  ExtraInput extra = ExtraInput::none;
  bool both_kinds = false;  ///< it wants the other kind of AO, too
  /// E/π at an albedo in [0, 1]; nothing outside the form's domain.
  std::function<std::optional<double>(const ModelInputs&, double albedo)> evaluate;
};

/// The closed forms that need no more than ModelInputs, published ones first, with their constants as
/// published or as SeenConstants says.
const std::vector<ClosedForm>& closed_forms();

/// What a map's n and A say about t, the n of its deepest places: sums over its texels weighted by w =
/// (∂G/∂n)² at albedo ½, so that errors of n count as what they do to the total.
struct SeenMoments {
  double weight = 0;    ///< Σ w
  double sky = 0;       ///< Σ w A
  double sky_sky = 0;   ///< Σ w A²
  double seen = 0;      ///< Σ w n
  double seen_sky = 0;  ///< Σ w n A

  void add(SkyViewFactor<double> sky_view_factor, SeenSkyViewFactor<double> n);
};

/// t, one number per map, from its simulation: the one with which guess_seen_in_deep comes nearest to the
/// map's own n, in least squares. 1 where nothing is occluded.
SeenSkyViewFactor<double> tune_deep_seen(const SeenMoments& moments, const SeenConstants& constants = {});

/// s = Σ A(1 − A)/n_z ÷ Σ (1 − A)/n_z over the map: the mean of n, weighted by (1 − A)/n_z, that reciprocity
/// asks for, since 1/n_z F is symmetric. From the sky view factor and the normals alone. 1 where nothing is
/// occluded. Texels that are NaN are left out. Throws Error for maps of different sizes.
SeenSkyViewFactor<double> expected_seen(const Map& sky_view_factor, const Surface& surface);

/// The same mean as measured: Σ E₁/n_z ÷ Σ (1 − A)/n_z, with `first_bounce` E₁/π at ρ = 1, 0 where missing.
/// How far it is from expected_seen tells how well the samples resolve the surface.
SeenSkyViewFactor<double> measured_seen(const Map& sky_view_factor, const TexelVector& first_bounce,
                                        const Surface& surface);

/// n of every texel, with which bounced_total gives `total`, E/π at kSeenAlbedo; NaN where the sample is
/// missing.
Map solve_seen(const Map& sky_view_factor, const TexelVector& total);

/// W: the sky view factor averaged by a Gaussian of `sigma` texels > 0 (cut at 3 σ; wrapped where the map
/// tiles, ended at its edges where not) with weights 1 − A, since occluded places are what is seen. From the
/// sky view factor alone. The plain A where nothing near is occluded; NaN where missing.
Map blur_seen(const Map& sky_view_factor, bool tiles, double sigma = kBlurSigma);

}  // namespace heightlight
