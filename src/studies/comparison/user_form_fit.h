#pragma once

#include <string>
#include <vector>

#include "comparison/contenders.h"
#include "user_form/user_form.h"

namespace heightlight {

/// A user's form with the constants that suit one map.
struct FormOnMap {
  UserForm form;
  std::vector<double> constants;
  double rms = 0;           ///< of the total, all albedos together, over what it was fitted to
  double left_out_rms = 0;  ///< over each half of the map, by what was fitted to the other half
};

/// Fits to the totals that the reference has, on its own AO, over at most 16384 texels on a lattice; a form
/// without constants is judged as it is. Throws Error as fit_family does.
FormOnMap fit_on_map(const UserForm& form, const ComparedScene& scene, const ComparisonReference& reference);

}  // namespace heightlight
