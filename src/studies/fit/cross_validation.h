#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "fit/error_tally.h"
#include "fit/fit_points.h"
#include "fit/trial_forms.h"
#include "heightlight/watch.h"

namespace heightlight {

/// Errors are binned by the form's own AO, for figures.
constexpr int kErrorBins = 20;

/// What is put on trial: a form, and where its constants come from.
struct JudgedForm {
  std::string name;
  std::string formula;
  std::string source;
  AoKind kind = AoKind::sky_view_factor;
  ExtraInput extra = ExtraInput::none;
  bool both_kinds = false;   ///< it wants the other kind of AO, too
  bool fitted = false;       ///< constants fitted without the material judged; otherwise fixed
  double outside_share = 0;  ///< of the texels or bins: outside the form's domain, and in no error

  /// Per judged albedo: over everything, and by AO.
  std::vector<ErrorTally> errors = {};
  std::vector<std::array<ErrorTally, kErrorBins>> errors_by_ao = {};
};

/// Every form's errors, material after material left out of the fits that judge it.
struct CrossValidation {
  std::size_t materials = 0;
  std::vector<JudgedForm> per_texel;  ///< over texels of the maps that have them; empty where none has
  std::vector<JudgedForm> per_texel_resolved;  ///< of those, over maps that their samples resolve
  std::vector<JudgedForm> per_bin;             ///< over bins' means; forms of AO and s alone
};

/// Judges the forms on trial, fixed ones as they are and families fitted anew; they must outlive what it
/// returns. With one material only, forms are judged on what they were fitted to. `watch` sees how far it is.
/// Throws Error as fit_family does.
CrossValidation cross_validate(const std::vector<JudgedMap>& maps, const TrialForms& trial,
                               const Watch& watch);

}  // namespace heightlight
