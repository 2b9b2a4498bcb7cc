#include "comparison/sky_comparison.h"

#include <cmath>

namespace heightlight {
namespace {

constexpr int kOpenRows = 32;  // of the prefiltered sky: 5.6°, where irradiance hardly changes

/// Red, green and blue as maps.
std::array<Map, 3> channels_of(const Image<Vector3>& light) {
  std::array<Map, 3> channels{Map(light.width, light.height), Map(light.width, light.height),
                              Map(light.width, light.height)};
  for (std::size_t i = 0; i < light.size(); ++i) {
    channels[0].values[i] = light.values[i].x;
    channels[1].values[i] = light.values[i].y;
    channels[2].values[i] = light.values[i].z;
  }
  return channels;
}

RenderedForm render(const std::string& title, const std::string& label, const Image<Vector3>& light) {
  RenderedForm rendered{.title = title, .label = label};
  rendered.reflected = channels_of(light);
  for (Map& channel : rendered.reflected) {
    channel = thin_out(channel);
    for (float& value : channel.values) value *= kSkyExposure;
  }
  return rendered;
}

/// Of all channels side by side.
ErrorStatistics error_of(const Image<Vector3>& light, const Image<Vector3>& reference) {
  Map differences(3 * light.width, light.height);
  for (std::size_t i = 0; i < light.size(); ++i) {
    differences.values[3 * i] = light.values[i].x - reference.values[i].x;
    differences.values[3 * i + 1] = light.values[i].y - reference.values[i].y;
    differences.values[3 * i + 2] = light.values[i].z - reference.values[i].z;
  }
  return measure(differences);
}

/// A times the prefiltered sky along a direction.
Image<Vector3> light_of_occlusion(const Map& sky_view_factor, const Image<Vector3>& direction,
                                  const SkyLight& open) {
  Image<Vector3> light(sky_view_factor.width, sky_view_factor.height);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const float sky = sky_view_factor.values[i];
    const Vector3 received = std::isnan(sky) ? Vector3{} : look_up(open, direction.values[i]);
    light.values[i] = {sky * received.x, sky * received.y, sky * received.z};
  }
  return light;
}

}  // namespace

SkyComparison::SkyComparison(const ComparisonReference& reference)
    : reference_(reference), open_(open_irradiance(reference.sky.light, kOpenRows)) {}

SkyLightResult SkyComparison::result(const Contender& contender, const std::string& variant,
                                     const Image<Vector3>& light, Cost cost) const {
  const std::string method = contender.role.empty() ? contender.method : contender.role;
  SkyLightResult result{.variant = variant,
                        .cost = cost,
                        .error = error_of(light, reference_.sky_light),
                        .rendered = render(method, variant.empty() ? contender.parameters : variant, light)};
  result.rendered.rmse = result.error.rmse;
  return result;
}

std::vector<SkyLightResult> SkyComparison::compare_occlusion(const Contender& contender,
                                                             const Estimate& estimate, const Surface& surface,
                                                             Cost cost) const {
  std::vector<SkyLightResult> results;
  const auto add = [&](const Image<Vector3>& direction, const char* variant) {
    const Stopwatch watch;
    const Image<Vector3> light = light_of_occlusion(estimate.sky_view_factor, direction, open_);
    results.push_back(result(contender, variant, light, cost + watch.elapsed()));
  };
  add(surface.normal, kByNormal);
  if (estimate.bent_normal.size() > 0) add(estimate.bent_normal, kByBentNormal);
  return results;
}

SkyLightResult SkyComparison::compare_own(const Contender& contender) {
  SkyGrid& grid = grids_[contender.sky_solid_angle];
  if (grid.side == 0) grid = make_sky_grid(reference_.sky.light, contender.sky_solid_angle);
  Image<Vector3> light;
  const Cost cost = least_cost([&] { light = contender.run_under_sky(grid); });
  return result(contender, "", light, cost);
}

RenderedForm SkyComparison::exact() const {
  return render("exact", std::to_string(reference_.azimuths) + " azimuths", reference_.sky_light);
}

}  // namespace heightlight
