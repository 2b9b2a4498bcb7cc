#include "cli/visibility_options.h"

#include <cmath>

#include "heightlight/error.h"

namespace heightlight {

void add_visibility_options(CLI::App& command, VisibilityOptions& options) {
  command
      .add_option("--visibility", options.method,
                  "horizon: walks along azimuths, the fast way (default); rays: the reference")
      ->check(CLI::IsMember({"horizon", "rays"}));
  command.add_option(
      "--error", options.error,
      "RMSE wanted of the sky view factor and of the total (0.002); 0: exact slices, far slower");
  command.add_option("--azimuths", options.azimuths,
                     "azimuths of the sky, an even number (chosen for --error)");
  command.add_option("--rays", options.rays, "rays per texel, 1 to 65536 (300); means --visibility rays");
}

void check_visibility_options(const VisibilityOptions& options, std::uint64_t seed) {
  if (options.method == "horizon" && options.rays) {
    throw UsageError("--rays: horizon walks send none; leave it out, or choose --visibility rays");
  }
  if (options.by_rays()) {
    if (options.azimuths) throw UsageError("--azimuths: rays have none; use --rays");
    if (options.error) throw UsageError("--error: rays do not aim at one; use --rays");
    check_ray_options({options.ray_count(), seed});
    return;
  }
  if (options.azimuths) check_azimuths(*options.azimuths);
  if (!(options.error_wanted() >= 0) || options.error_wanted() > 1) {
    throw UsageError("--error " + std::to_string(options.error_wanted()) + ": must be from 0 to 1");
  }
}

FoundVisibility find_visibility(const Surface& surface, const VisibilityOptions& options,
                                const RunOptions& run, const std::string& map_name, std::uint64_t memory) {
  FoundVisibility found;
  FormFactorOptions stored;
  stored.rays = {options.ray_count(), run.seed};
  stored.memory_limit = memory;
  stored.quiet = run.quiet;
  stored.map_name = map_name;
  if (options.by_rays()) {
    found.transport = std::make_unique<FormFactors>(build_form_factors(surface, stored));
  } else if (options.exact()) {
    found.transport =
        std::make_unique<FormFactors>(build_exact_form_factors(surface, options.exact_azimuths(), stored));
  } else {
    PlannedTransport planned = plan_horizon_transport(
        surface, {options.error_wanted(), false, options.azimuths.value_or(0), run.seed},
        {memory, run.quiet});
    found.transport = std::move(planned.transport);
    found.plan = planned.plan;
  }
  return found;
}

}  // namespace heightlight
