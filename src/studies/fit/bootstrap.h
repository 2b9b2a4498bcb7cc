#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "fit/fit_points.h"

namespace heightlight {

/// 95 % intervals of the parameters.
struct ParameterIntervals {
  std::string unit;  ///< what was drawn: "materials", or "bins" where there are fewer than four of those
  int draws = 0;
  Eigen::VectorXd low;
  Eigen::VectorXd high;
};

/// Whether the maps tell a parameter: its interval is no wider than twice what it is, or was published as.
bool is_determined(const FormFamily& family, const Eigen::VectorXd& best, const ParameterIntervals& intervals,
                   Eigen::Index parameter);

/// Bootstrap: fits to as many materials (or points) as there are, drawn with replacement; 2.5 % and 97.5 % of
/// what comes out. Draws whose fit fails are left out; throws Error where that is more than a tenth of them.
ParameterIntervals bootstrap_family(const FormFamily& family, const std::vector<FitPoint>& points,
                                    const std::vector<JudgedMap>& maps, const Eigen::VectorXd& best,
                                    int draws, std::uint64_t seed);

}  // namespace heightlight
