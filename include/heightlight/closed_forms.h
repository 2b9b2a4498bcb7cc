#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/curves.h"
#include "heightlight/forms.h"
#include "heightlight/image.h"
#include "heightlight/surface.h"

// A list of the closed forms of forms.h, and the quantities of one map that some of them need.

namespace heightlight {

/// All the quantities of a texel that a closed form may use.
struct ModelInputs {
  AmbientOcclusion<double> ambient_occlusion{0};
  SkyViewFactor<double> sky_view_factor{0};
  SeenSkyViewFactor<double> expected_seen{0};  ///< s = expected_seen(…), one number per map
  SeenSkyViewFactor<double> deep_seen{0};      ///< t = tune_deep_seen(…), one number per map
  SeenSkyViewFactor<double> blurred{0};        ///< W = blur_seen(…), the blurred sky view factor
  SeenSkyViewFactor<double> seen{0};  ///< n of the texel itself, stored as a second channel of the AO map
};

/// What a closed form needs beside its AO: nothing, or the field of that name in ModelInputs.
enum class ExtraInput { none, expected_seen, deep_seen, blurred, seen };

/// One closed form of the list.
struct ClosedForm {
  std::string name;         ///< as it stands in tables, snake_case
  std::string description;  ///< the formula, plain ASCII
  std::string source;       ///< paper and equation, or "here"
  AoKind kind = AoKind::sky_view_factor;
  ExtraInput extra = ExtraInput::none;
  bool both_kinds = false;  ///< the form needs the other kind of AO, too
  /// E/π of all bounces at an albedo in [0, 1]. Nothing outside the form's domain; NaN where the AO is NaN.
  std::function<std::optional<double>(const ModelInputs&, double albedo)> evaluate;
};

/// Returns the closed forms that need nothing beyond ModelInputs, published ones first. Their constants are
/// those published, or the defaults of SeenConstants.
const std::vector<ClosedForm>& closed_forms();

/// Sums over the texels of one map, from which tune_deep_seen finds t, the n of the deepest places. Each
/// texel has the weight w = (∂G/∂n)² at albedo ½, so that an error of n counts by what it changes in the
/// total.
struct SeenMoments {
  double weight = 0;    ///< Σ w
  double sky = 0;       ///< Σ w A
  double sky_sky = 0;   ///< Σ w A²
  double seen = 0;      ///< Σ w n
  double seen_sky = 0;  ///< Σ w n A

  /// Adds one texel. A is clamped to [0, 1].
  void add(SkyViewFactor<double> sky_view_factor, SeenSkyViewFactor<double> n);
};

/// Returns t, one number per map, in [0, 1]: the value with which guess_seen_in_deep comes nearest, in
/// weighted least squares, to the n that a simulation of the map gave. 1 where nothing is occluded.
SeenSkyViewFactor<double> tune_deep_seen(const SeenMoments& moments, const SeenConstants& constants = {});

/// Returns s = Σ A(1 − A)/n_z ÷ Σ (1 − A)/n_z over the map, in [0, 1]. It is the mean of n, weighted by (1 −
/// A)/n_z, that reciprocity requires, since (1/n_z) F is symmetric. Only the sky view factor and the normals
/// are needed. 1 where nothing is occluded. Texels that are NaN are left out. Throws Error for maps of
/// different sizes.
SeenSkyViewFactor<double> expected_seen(const Map& sky_view_factor, const Surface& surface);

/// Returns the mean that expected_seen predicts, as measured: Σ E₁/(π n_z) ÷ Σ (1 − A)/n_z. `first_bounce` is
/// E₁/π at ρ = 1 per texel, 0 where the sample is missing. Its difference from expected_seen shows how well
/// the samples resolve the surface. Returns 1 where nothing is occluded, and throws Error, as expected_seen
/// does.
SeenSkyViewFactor<double> measured_seen(const Map& sky_view_factor, const TexelVector& first_bounce,
                                        const Surface& surface);

/// Returns n of every texel, in [0, 1]: the value with which bounced_total gives `total`, which is E/π of all
/// bounces at the albedo kSeenAlbedo. 1 where nothing is occluded; NaN where the sample is missing.
Map solve_seen(const Map& sky_view_factor, const TexelVector& total);

/// Returns W: the sky view factor averaged by a Gaussian of `sigma` texels > 0, cut at 3 σ. The Gaussian
/// wraps where the map tiles, and ends at the edges where it does not. The weights are 1 − A, since occluded
/// places are the ones that are seen. Only the sky view factor is needed. W is A itself where nothing near is
/// occluded, and NaN where the sample is missing.
Map blur_seen(const Map& sky_view_factor, bool tiles, double sigma = kBlurSigma);

}  // namespace heightlight
