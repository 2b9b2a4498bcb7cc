#include "embree_methods.h"

#include <limits>

namespace heightlight {
namespace {

double core_ns_per_ray(const EmbreeRays& rays, const Receivers& receivers) {
  const Cost cost = least_cost([&] { rays.sky_view_factors(receivers); });
  return 1e9 * cost.core / (static_cast<double>(receivers.size()) * kEmbreeTrialRays);
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
  for (const EmbreePrimitive primitive : {EmbreePrimitive::quad, EmbreePrimitive::triangle}) {
    for (const RTCBuildQuality quality : {RTC_BUILD_QUALITY_MEDIUM, RTC_BUILD_QUALITY_HIGH}) {
      const Stopwatch build;
      const auto mesh = std::make_shared<const EmbreeMesh>(surface, primitive, quality);
      EmbreeTree tree{primitive, quality, build.elapsed(), {}};
      for (const EmbreeMode mode : embree_modes()) {
        const EmbreeRays rays(surface, *mesh, mode, RayDensity::cosine, kEmbreeTrialRays);
        tree.ray_core_ns.push_back(core_ns_per_ray(rays, receivers));
        const double core = tree.built.core + 1e-9 * tree.ray_core_ns.back() * map_rays;
        if (core >= least) continue;
        least = core;
        best.mesh = mesh;
        best.mode = mode;
        best.built = tree.built;
      }
      best.trees.push_back(std::move(tree));
    }
  }
  return best;
}

std::vector<Method> embree_sky_methods(const Surface& surface, const EmbreeBest& best) {
  std::vector<Method> methods;
  for (const RayDensity density : {RayDensity::cosine, RayDensity::solid_angle}) {
    const auto rays = std::make_shared<std::unique_ptr<EmbreeRays>>();
    Method method;
    method.name = density == RayDensity::cosine ? "Embree, cosine density" : "Embree, uniform density";
    method.parameter = "rays";
    method.settings = geometric_settings(16, 16384);
    method.granularity = 8;
    method.is_baseline = true;
    method.built = best.built;
    method.set_up = [rays, &surface, mesh = best.mesh, mode = best.mode, density](int count) {
      *rays = std::make_unique<EmbreeRays>(surface, *mesh, mode, density, count);
    };
    method.run_receivers = [rays](int, const Receivers& receivers) {
      return (*rays)->sky_view_factors(receivers);
    };
    methods.push_back(std::move(method));
  }
  return methods;
}

}  // namespace heightlight
