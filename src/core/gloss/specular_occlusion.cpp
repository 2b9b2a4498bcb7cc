#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "gloss/lobe_visibility.h"
#include "heightlight/error.h"
#include "heightlight/gloss.h"

namespace heightlight {
namespace {

constexpr int kMostLobeRays = 65536;
constexpr int kFirstLobeRays = 64;  ///< where `error` decides the number of rays

void check_specular_options(const SpecularOptions& options) {
  check_gloss(options.gloss);
  check_view(options.view);
  if (options.rays == 0) {
    if (!(options.error > 0)) throw UsageError("error", std::to_string(options.error), "must be above 0");
  } else if (options.rays < kLobeParts || options.rays > kMostLobeRays) {
    throw UsageError("rays", std::to_string(options.rays),
                     "must be from " + std::to_string(kLobeParts) + " to " + std::to_string(kMostLobeRays));
  }
}

/// Sums over one row of texels.
struct RowErrors {
  double squares = 0;
  std::size_t count = 0;
};

SpecularOcclusion look_with_rays(const Surface& surface, const SpecularOptions& options) {
  const RayCaster caster(surface, {.rays = options.rays});
  const LookedLobe lobe{.sampler = ggx_sampler(options.gloss),
                        .view = as_eigen(options.view).cast<double>().normalized(),
                        .rays = options.rays,
                        .seed = options.seed};
  SpecularOcclusion found;
  found.rays = options.rays;
  found.occlusion = Map(surface.width(), surface.height());
  std::vector<RowErrors> rows(static_cast<std::size_t>(surface.height()));
  Progress progress("specular occlusion", surface.height(), options.watch);
  parallel_for(
      surface.height(),
      [&](std::int64_t i) {
        const int row = static_cast<int>(i);
        LobeWorkspace work(options.rays);
        RowErrors& errors = rows[static_cast<std::size_t>(i)];
        for (int column = 0; column < surface.width(); ++column) {
          const LobeShare share = look_by_rays(caster, surface, row, column, lobe, work);
          found.occlusion(row, column) = static_cast<float>(share.open);
          if (std::isnan(share.open)) continue;
          errors.squares += share.error * share.error;
          ++errors.count;
        }
      },
      &progress);
  RowErrors all;
  for (const RowErrors& row : rows) {
    all.squares += row.squares;
    all.count += row.count;
  }
  found.rmse = all.count > 0 ? std::sqrt(all.squares / static_cast<double>(all.count)) : 0;
  return found;
}

/// Number of rays to try next, when `found` misses the error. The error falls at least with the root of their
/// number.
int more_rays(const SpecularOcclusion& found, double error) {
  const double ratio = found.rmse / error;
  return std::min(kMostLobeRays, (ratio * ratio > 2 ? 4 : 2) * found.rays);
}

}  // namespace

SpecularOcclusion specular_occlusion(const Surface& surface, const SpecularOptions& options) {
  check_specular_options(options);
  if (options.rays > 0) return look_with_rays(surface, options);
  SpecularOptions tried = options;
  tried.rays = kFirstLobeRays;
  for (;;) {
    SpecularOcclusion found = look_with_rays(surface, tried);
    if (found.rmse <= options.error || found.rays >= kMostLobeRays) return found;
    tried.rays = more_rays(found, options.error);
  }
}

}  // namespace heightlight
