#pragma once

#include <functional>
#include <vector>

#include "heightlight/transport.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// A value by the texel's index; called from many threads.
using ValueAt = std::function<double(std::size_t)>;

/// What was found of a total, wherever it is kept.
struct FoundTotal {
  ValueAt total = {};  ///< E/π
  ValueAt albedo = {};
  ValueAt direct = {};  ///< E₀/π of one's own; empty: the sky's
};

struct FoundMaps {
  ValueAt sky = {};      ///< A
  ValueAt ambient = {};  ///< α; empty: it is not compared
  std::vector<FoundTotal> totals = {};
};

/// An error that is more than so many times the one wanted is missed.
constexpr double kMissed = 1.15;

/// Whether an RMSE that a check found misses the error wanted; one that is above it, too, where the check's
/// own standard error leaves that open.
constexpr bool is_missed(double rmse, double error_wanted, double standard_error = 0) {
  return rmse > error_wanted && rmse + standard_error > kMissed * error_wanted;
}

/// Azimuths that leave little beside the error wanted: on bricks 128 leave .0001 of A and .0003 of a gather,
/// 64 twice that and more.
int azimuths_for_check(double error_wanted);

/// check_by_exact_walks, by a walker of one's own. `class_sample`: A of the receivers that classes are made
/// by, a sample by options.seed + 5. Of the options α is not used.
std::vector<HorizonCheck> check_found(const ExactWalker& walker, const FoundMaps& found,
                                      std::vector<double> class_sample, const CheckOptions& options);

}  // namespace heightlight
