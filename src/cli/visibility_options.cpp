#include "cli/visibility_options.h"

#include <string>

#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr int kDefaultRays = 300;
constexpr double kDefaultError = 0.002;

}  // namespace

void add_visibility_options(CLI::App& command, VisibilityOptions& options) {
  command
      .add_option("--visibility", options.method,
                  "method to find visibility; horizon: walks along azimuths, fast (default); rays: the "
                  "slower reference method")
      ->check(CLI::IsMember({"horizon", "rays"}));
  command.add_option("--error", options.error,
                     "wanted RMSE of the sky view factor and of the total irradiance, from 0 to 1 (default "
                     "0.002); 0 selects exact slices, which are far slower");
  command.add_option("--azimuths", options.azimuths,
                     "number of azimuths of the sky, even, 2 to 65536 (default: as many as --error needs)");
  command.add_option("--rays", options.rays,
                     "rays per texel, 1 to 65536 (default 300); implies --visibility rays");
}

void check_visibility_options(const VisibilityOptions& options) {
  if (options.method == "horizon" && options.rays) {
    throw UsageError("rays", "",
                     "is not used by --visibility horizon; leave it out, or choose --visibility rays");
  }
  if (options.by_rays()) {
    if (options.azimuths)
      throw UsageError("azimuths", "", "is not used by --visibility rays; set --rays instead");
    if (options.error) throw UsageError("error", "", "is not used by --visibility rays; set --rays instead");
    check_ray_options({.rays = options.rays.value_or(kDefaultRays)});
    return;
  }
  if (options.azimuths) check_azimuths(*options.azimuths);
  const double error = options.error.value_or(kDefaultError);
  if (!(error >= 0) || error > 1) throw UsageError("error", std::to_string(error), "must be from 0 to 1");
}

Accuracy make_accuracy(const VisibilityOptions& options, std::uint64_t seed) {
  const double error = options.error.value_or(kDefaultError);
  Accuracy accuracy;
  accuracy.visibility = options.by_rays() ? Visibility::rays
                        : error == 0      ? Visibility::exact_slices
                                          : Visibility::horizon_walks;
  accuracy.error = error;
  accuracy.azimuths = options.azimuths.value_or(0);
  accuracy.rays = options.rays.value_or(kDefaultRays);
  accuracy.seed = seed;
  return accuracy;
}

}  // namespace heightlight
