#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "heightlight/solve.h"

namespace heightlight {

/// How the user wants visibility to be found.
struct VisibilityOptions {
  std::string method;  ///< "horizon", "rays", or empty: rays where their number is given, else horizon
  std::optional<int>
      rays;  ///< 300 where absent, so that each of 100 bins holds three of the values α can take
  std::optional<int> azimuths;  ///< chosen for the error wanted where absent
  std::optional<double> error;  ///< RMSE of A and of the total; 0: exact slices; 0.002 where absent

  bool by_rays() const { return method == "rays" || (method.empty() && rays); }
};

/// Adds `--visibility --rays --azimuths --error`.
void add_visibility_options(CLI::App& command, VisibilityOptions& options);

/// Throws UsageError naming the option that is out of its range or contradicts another.
void check_visibility_options(const VisibilityOptions& options);

/// What a request says of it.
Accuracy make_accuracy(const VisibilityOptions& options, std::uint64_t seed);

}  // namespace heightlight
