#include "ray_methods.h"

#include <memory>
#include <optional>

#include "heightlight/transport.h"

namespace heightlight {

std::vector<float> trace_sky(const RayCaster& caster, const Receivers& receivers) {
  const auto width = static_cast<std::size_t>(caster.grid().width);
  std::vector<float> sky(receivers.size());
  for_runs(receivers.size(), [&](std::size_t begin, std::size_t end) {
    RayWorkspace workspace(caster.rays());
    ReceiverView view;
    for (std::size_t i = begin; i < end; ++i) {
      caster.view(static_cast<int>(receivers[i] / width), static_cast<int>(receivers[i] % width), workspace,
                  view);
      sky[i] = static_cast<float>(sky_share(view).sky_view_factor);
    }
  });
  return sky;
}

Method ray_sky_method(const Surface& surface) {
  const auto caster = std::make_shared<std::optional<RayCaster>>();
  Method method;
  method.name = "our rays";
  method.parameter = "rays";
  method.settings = geometric_settings(16, 16384);
  method.set_up = [caster, &surface](int rays) {
    caster->emplace(surface, RayOptions{.rays = rays, .seed = 1});
  };
  method.run_receivers = [caster](int, const Receivers& receivers) { return trace_sky(**caster, receivers); };
  return method;
}

Method ray_total_method(const Surface& surface, double albedo) {
  Method method;
  method.name = "our rays, stored links";
  method.parameter = "rays";
  method.settings = geometric_settings(16, 2048);
  method.is_baseline = true;
  method.run_map = [&surface, albedo](int rays) {
    const FormFactors links = build_form_factors(surface, {.rays = rays, .seed = 1}, {});
    const TexelVector albedos(links.direct.size(), albedo);
    return to_map(solve_equilibrium(links, links.direct, albedos, links.direct).irradiance, surface);
  };
  return method;
}

}  // namespace heightlight
