#include "total_reference.h"

#include <algorithm>

#include "heightlight/transport.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

TexelVector solve_field(const Surface& surface, const TotalReferenceOptions& options) {
  const FormFactors links =
      build_form_factors(surface, {.rays = options.field_rays, .seed = options.seed}, {});
  const TexelVector albedo(links.direct.size(), options.albedo);
  return solve_equilibrium(links, links.direct, albedo, links.direct).irradiance;
}

/// Linear interpolation on the triangle of `place`, without rounding, because the rounding of links to bytes
/// is part of what is tested. The boundary is open, so that no cell wraps.
double field_at(const TexelVector& field, std::size_t width, const SurfacePoint& place) {
  const std::size_t corner = place.cell;
  const double both = std::min(place.across, place.down);
  const double upper_left = field[corner];
  return upper_left + (static_cast<double>(place.across) - both) * (field[corner + 1] - upper_left) +
         (static_cast<double>(place.down) - both) * (field[corner + width] - upper_left) +
         both * (field[corner + width + 1] - upper_left);
}

}  // namespace

ReferenceValues make_total_reference(const Surface& surface, const TotalReferenceOptions& options) {
  const TexelVector field = solve_field(surface, options);
  const RayCaster caster(surface, {.rays = 65536, .seed = scramble(options.seed)});
  ReferenceValues reference;
  reference.receivers = pick_receivers(surface, options.receivers);
  reference.values.resize(reference.receivers.size());
  for_runs(reference.receivers.size(), [&](std::size_t begin, std::size_t end) {
    RayWorkspace workspace(caster.rays());
    ReceiverView view;
    for (std::size_t i = begin; i < end; ++i) {
      const auto receiver = static_cast<int>(reference.receivers[i]);
      caster.view(receiver / surface.width(), receiver % surface.width(), workspace, view);
      double total = sky_share(view).sky_view_factor;
      for (std::size_t hit = 0; hit < view.ray.size(); ++hit) {
        total +=
            options.albedo * view.weight[view.ray[hit]] * field_at(field, surface.width(), view.place[hit]);
      }
      reference.values[i] = static_cast<float>(total);
    }
  });
  return reference;
}

}  // namespace heightlight
