#pragma once

#include <functional>
#include <vector>

#include "heightlight/transport.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// A value by the texel's index; called from many threads.
using ValueAt = std::function<double(std::size_t)>;

/// A total to be checked, wherever it is kept.
struct FoundTotal {
  ValueAt total = {};  ///< E/π
  ValueAt albedo = {};
  ValueAt direct = {};  ///< E₀/π of a user-given light; empty: the sky's
};

struct FoundMaps {
  ValueAt sky = {};      ///< A
  ValueAt ambient = {};  ///< α; empty: α is not compared
  std::vector<FoundTotal> totals = {};
};

/// An error above this many times the error wanted is missed.
constexpr double kMissed = 1.15;

/// Whether an RMSE that a check found misses the error wanted: it is above the error wanted, and, with the
/// check's own standard error added, above kMissed times that.
constexpr bool is_missed(double rmse, double error_wanted, double standard_error = 0) {
  return rmse > error_wanted && rmse + standard_error > kMissed * error_wanted;
}

/// Azimuths of a check whose own error is small beside the error wanted: on bricks 128 azimuths leave .0001
/// of A and .0003 of a gather, 64 leave twice that and more.
int azimuths_for_check(double error_wanted);

/// As check_by_exact_walks, with the walker given. `class_sample` is A of the receivers that set the classes'
/// bounds, a sample picked by options.seed + 5. α is taken from `found`, not from the options.
std::vector<HorizonCheck> check_found(const ExactWalker& walker, const FoundMaps& found,
                                      std::vector<double> class_sample, const CheckOptions& options);

}  // namespace heightlight
