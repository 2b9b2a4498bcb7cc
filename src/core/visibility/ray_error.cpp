#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hash.h"
#include "base/parallel.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

constexpr int kReceivers = 256;

double sky_view_factor(const RayCaster& caster, int row, int column) {
  RayWorkspace workspace(caster.rays());
  ReceiverView view;
  caster.view(row, column, workspace, view);
  return view.rays > 0 ? sky_share(view).sky_view_factor : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double estimate_ray_rmse(const Surface& surface, const RayOptions& options) {
  const RayCaster caster(surface, options);
  const RayCaster reference(surface, {std::min(options.rays * 16, 65536), scramble(options.seed)});
  std::vector<double> squared(kReceivers);
  parallel_for(kReceivers, [&](std::int64_t i) {
    const std::uint64_t texel =
        hash_combine(options.seed, static_cast<std::uint64_t>(i)) % surface.map.height.size();
    const int row = static_cast<int>(texel / static_cast<std::uint64_t>(surface.width()));
    const int column = static_cast<int>(texel % static_cast<std::uint64_t>(surface.width()));
    const double error = sky_view_factor(caster, row, column) - sky_view_factor(reference, row, column);
    squared[static_cast<std::size_t>(i)] = error * error;
  });
  double sum = 0;
  int present = 0;
  for (const double value : squared) {
    if (std::isnan(value)) continue;
    sum += value;
    ++present;
  }
  return present > 0 ? std::sqrt(sum / present) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace heightlight
