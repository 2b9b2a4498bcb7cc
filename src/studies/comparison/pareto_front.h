#pragma once

#include <string>
#include <vector>

#include "comparison/compare_methods.h"

namespace heightlight {

/// The rows of a quantity that none beats in both core-seconds and RMSE, from the cheapest to the most exact.
/// Rows of kExactMethod are left out: they are no way to find anything.
std::vector<const ComparisonRow*> pareto_front(const std::vector<ComparisonRow>& rows,
                                               const std::string& quantity);

/// The row of a quantity with an RMSE of at most `error` that takes the fewest core-seconds; null where none
/// is so exact.
const ComparisonRow* cheapest(const std::vector<ComparisonRow>& rows, const std::string& quantity,
                              double error);

}  // namespace heightlight
