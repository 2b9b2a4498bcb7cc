#pragma once

#include <cstdint>
#include <vector>

#include "fit/fit_report.h"
#include "heightlight/watch.h"
#include "user_form/user_form.h"

namespace heightlight {

struct FitStudy {
  int draws = 200;  ///< of the bootstrap, for the intervals of parameters: 20 … 100000
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// Throws UsageError unless the number of draws is in its range.
void check_bootstrap(int draws);

/// All that is to be known of the maps: families fitted to them, the user's `own` forms among them, and every
/// form judged on materials that its fit did not see. The report has no files. Throws as fit_family does.
FitReport fit_maps(std::vector<JudgedMap> maps, const std::vector<UserForm>& own, const FitStudy& study);

}  // namespace heightlight
