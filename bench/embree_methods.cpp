#include "embree_methods.h"

#include <limits>

namespace heightlight {
namespace {

double core_ns_per_ray(const EmbreeRays& rays, const Receivers& receivers) {
  const Cost cost = least_cost([&] { rays.sky_view_factors(receivers); });
  return 1e9 * cost.core / (static_cast<double>(receivers.size()) * kEmbreeTrialRays);
}

Method embree_sky_method(const Surface& surface, const std::string& name, const EmbreeWay& way,
                         RayDensity density) {
  const auto rays = std::make_shared<std::unique_ptr<EmbreeRays>>();
  Method method;
  method.name = name;
  method.parameter = "rays";
  method.settings = geometric_settings(16, 16384);
  method.granularity = 8;
  method.is_baseline = true;
  method.built = way.built;
  method.set_up = [rays, &surface, mesh = way.mesh, mode = way.mode, density](int count) {
    *rays = std::make_unique<EmbreeRays>(surface, *mesh, mode, density, count);
  };
  method.run_receivers = [rays](int, const Receivers& receivers) {
    return (*rays)->sky_view_factors(receivers);
  };
  return method;
}

}  // namespace

std::vector<EmbreeMode> embree_modes() {
  std::vector<EmbreeMode> modes{{EmbreeCall::single, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT}};
  for (const EmbreeCall call : {EmbreeCall::packet8, EmbreeCall::packet16, EmbreeCall::stream}) {
    modes.push_back({call, RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT});
    modes.push_back({call, RTC_INTERSECT_CONTEXT_FLAG_COHERENT});
  }
  return modes;
}

EmbreeBest find_embree_best(const Surface& surface) {
  constexpr int kRows = 4;
  const Receivers receivers = row_receivers(surface, kRows);
  const double map_rays = static_cast<double>(surface.map.height.size()) * kEmbreeTrialRays;
  EmbreeBest best;
  double least = std::numeric_limits<double>::infinity();
  double least_of_packets = least;
  const auto keep_cheapest = [](double core, const EmbreeWay& way, double& cheapest, EmbreeWay& kept) {
    if (core >= cheapest) return;
    cheapest = core;
    kept = way;
  };
  for (const EmbreePrimitive primitive : {EmbreePrimitive::quad, EmbreePrimitive::triangle}) {
    for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH}) {
      const Stopwatch build;
      const auto mesh = std::make_shared<const EmbreeMesh>(surface, primitive, quality);
      EmbreeTree tree{primitive, quality, build.elapsed(), {}};
      for (const EmbreeMode mode : embree_modes()) {
        const EmbreeRays rays(surface, *mesh, mode, RayDensity::cosine, kEmbreeTrialRays);
        tree.ray_core_ns.push_back(core_ns_per_ray(rays, receivers));
        const double core = tree.built.core + 1e-9 * tree.ray_core_ns.back() * map_rays;
        const EmbreeWay way{mesh, mode, tree.built};
        keep_cheapest(core, way, least, best.any);
        const bool packets = mode.call == EmbreeCall::packet8 || mode.call == EmbreeCall::packet16;
        if (packets) keep_cheapest(core, way, least_of_packets, best.packets);
      }
      best.trees.push_back(std::move(tree));
    }
  }
  return best;
}

std::vector<Method> embree_sky_methods(const Surface& surface, const EmbreeBest& best) {
  return {embree_sky_method(surface, "Embree, cosine density", best.any, RayDensity::cosine),
          embree_sky_method(surface, "Embree, uniform density", best.any, RayDensity::solid_angle),
          embree_sky_method(surface, "Embree, packets", best.packets, RayDensity::cosine)};
}

}  // namespace heightlight
