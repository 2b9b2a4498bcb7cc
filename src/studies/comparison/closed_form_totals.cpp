#include "comparison/closed_form_totals.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace heightlight {
namespace {

bool has(const Map& map) { return map.size() > 0; }

/// t, from a map of n.
SeenSkyViewFactor<double> deep_seen(const Estimate& estimate) {
  SeenMoments moments;
  for (std::size_t i = 0; i < estimate.seen.size(); ++i) {
    if (std::isnan(estimate.sky_view_factor.values[i])) continue;
    moments.add(SkyViewFactor<double>(double{estimate.sky_view_factor.values[i]}),
                SeenSkyViewFactor<double>(double{estimate.seen.values[i]}));
  }
  return tune_deep_seen(moments);
}

}  // namespace

bool can_evaluate(const ClosedForm& form, const Estimate& estimate) {
  if (form.both_kinds && !(has(estimate.ambient_occlusion) && has(estimate.sky_view_factor))) return false;
  const bool wants_seen = form.extra == ExtraInput::seen || form.extra == ExtraInput::deep_seen;
  if (wants_seen && !has(estimate.seen)) return false;
  if (form.extra != ExtraInput::none && !has(estimate.sky_view_factor)) return false;
  return has(form.kind == AoKind::ambient_occlusion ? estimate.ambient_occlusion : estimate.sky_view_factor);
}

Map evaluate_closed_form(const ClosedForm& form, const Estimate& estimate, const Surface& surface,
                         const ComparedAlbedo& albedo) {
  const Map& occlusion =
      form.kind == AoKind::ambient_occlusion ? estimate.ambient_occlusion : estimate.sky_view_factor;
  Map blurred;
  if (form.extra == ExtraInput::blurred) blurred = blur_seen(estimate.sky_view_factor, surface.tiles());
  SeenSkyViewFactor<double> expected{0};
  if (form.extra == ExtraInput::expected_seen) expected = expected_seen(estimate.sky_view_factor, surface);
  SeenSkyViewFactor<double> deep{0};
  if (form.extra == ExtraInput::deep_seen) deep = deep_seen(estimate);
  const auto value_at = [](const Map& map, std::size_t i) {
    return has(map) ? double{map.values[i]} : std::numeric_limits<double>::quiet_NaN();
  };
  Map total(surface.width(), surface.height());
  parallel_for(total.height, [&](std::int64_t row) {
    for (std::int64_t i = row * total.width; i < (row + 1) * total.width; ++i) {
      const auto at = static_cast<std::size_t>(i);
      ModelInputs inputs;
      inputs.ambient_occlusion = AmbientOcclusion(value_at(estimate.ambient_occlusion, at));
      inputs.sky_view_factor = SkyViewFactor(value_at(estimate.sky_view_factor, at));
      inputs.expected_seen = expected;
      inputs.deep_seen = deep;
      inputs.blurred = SeenSkyViewFactor(value_at(blurred, at));
      inputs.seen = SeenSkyViewFactor(value_at(estimate.seen, at));
      const std::optional<double> found = std::isnan(double{occlusion.values[at]})
                                              ? std::nullopt
                                              : form.evaluate(inputs, albedo.reflectance[at]);
      total.values[at] = found ? static_cast<float>(*found) : std::numeric_limits<float>::quiet_NaN();
    }
  });
  return total;
}

}  // namespace heightlight
