#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "cli/map_options.h"
#include "heightlight/transport.h"

namespace heightlight {

/// How the user wants visibility to be found.
struct VisibilityOptions {
  std::string method;  ///< "horizon", "rays", or empty: rays where their number is given, else horizon
  std::optional<int>
      rays;  ///< 300 where absent, so that each of 100 bins holds three of the values α can take
  std::optional<int> azimuths;  ///< chosen for the error wanted where absent
  std::optional<double> error;  ///< RMSE of A and of the total; 0: exact slices; 0.002 where absent

  bool by_rays() const { return method == "rays" || (method.empty() && rays); }
  bool exact() const { return !by_rays() && error_wanted() == 0; }
  int ray_count() const { return rays.value_or(300); }
  double error_wanted() const { return error.value_or(0.002); }
  int exact_azimuths() const { return azimuths.value_or(128); }
};

/// Adds `--visibility --rays --azimuths --error`.
void add_visibility_options(CLI::App& command, VisibilityOptions& options);

/// Throws UsageError naming the option that is out of its range or contradicts another.
void check_visibility_options(const VisibilityOptions& options, std::uint64_t seed);

/// The operator, and how it was found.
struct FoundVisibility {
  std::unique_ptr<Transport> transport;
  std::optional<HorizonPlan> plan;  ///< of fast horizon walks
};

/// `memory` is what links may take. Throws what the builders throw.
FoundVisibility find_visibility(const Surface& surface, const VisibilityOptions& options,
                                const RunOptions& run, const std::string& map_name, std::uint64_t memory);

}  // namespace heightlight
