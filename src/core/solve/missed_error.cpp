#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/digits.h"
#include "solve/solver.h"

namespace heightlight {

std::string missed_error(const Evidence& evidence) {
  const double wanted = evidence.error_wanted;
  if (!(wanted > 0)) return {};
  double total = 0;  // the largest of those that miss
  for (const HorizonCheck& check : evidence.total_checks) {
    if (is_missed(check.total_rmse, wanted, check.total_standard_error))
      total = std::max(total, check.total_rmse);
  }
  std::string found;
  if (evidence.sky_rmse && is_missed(*evidence.sky_rmse, wanted))
    found = in_digits(*evidence.sky_rmse, 2) + " of the sky view factor";
  if (total > 0) found += (found.empty() ? "" : ", ") + in_digits(total, 2) + " of the total";
  for (const DefinitionCheck& check : evidence.definition_checks) {
    if (is_missed(check.rmse.value_or(0), wanted) && !is_of_sky(check.definition))
      found +=
          (found.empty() ? "" : ", ") + in_digits(*check.rmse, 2) + " of " + facts_of(check.definition).name;
  }
  if (found.empty()) return {};
  return "the error wanted, " + in_digits(evidence.error_wanted, 2) +
         ", is missed: exact walks find an RMSE of " + found;
}

std::vector<std::string> find_faults(const Evidence& evidence) {
  constexpr double kConverged = 1e-6;  // a hundred times what the solver aims at
  std::vector<std::string> faults;
  if (std::string missed = missed_error(evidence); !missed.empty()) faults.push_back(std::move(missed));
  if (!(evidence.solver_residual <= kConverged)) {
    faults.push_back("the light of all bounces did not converge: after " +
                     std::to_string(evidence.solver_iterations) + " steps a relative residual of " +
                     in_digits(evidence.solver_residual, 2) + " is left");
  }
  return faults;
}

}  // namespace heightlight
