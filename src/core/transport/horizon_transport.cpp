#include <cmath>
#include <string>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/horizon_plan.h"
#include "transport/seen_light.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

TexelVector to_vector(const Map& map) {
  TexelVector values(map.size());
  parallel_for(map.height, [&](std::int64_t row) {
    const std::size_t begin = map.index(static_cast<int>(row), 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(map.width); ++i) {
      values[i] = std::isnan(map.values[i]) ? 0 : double{map.values[i]};
    }
  });
  return values;
}

class HorizonTransport : public Transport {
 public:
  HorizonTransport(HorizonSky sky, std::unique_ptr<HeightMips> mips, std::unique_ptr<SeenLight> light)
      : mips_(std::move(mips)), light_(std::move(light)) {
    ambient_occlusion = std::move(sky.ambient_occlusion);
    sky_view_factor = std::move(sky.sky_view_factor);
    direct = to_vector(sky_view_factor);
  }

  TexelVector gather(const TexelVector& x) const override {
    TexelVector result(x.size());
    light_->gather(x, direct, result);
    return result;
  }

  /// Gathers are made in single precision.
  double solver_tolerance() const override { return 1e-6; }
  std::uint64_t link_count() const override { return light_->link_count(); }
  std::uint64_t bytes() const override { return light_->bytes(); }

 private:
  std::unique_ptr<HeightMips> mips_;  ///< which the light refers to
  std::unique_ptr<SeenLight> light_;  ///< gathers change nothing but its buffers
};

}  // namespace

std::unique_ptr<Transport> build_horizon_transport(const Surface& surface, const HorizonPlan& plan,
                                                   const LinkLimits& limits) {
  check_azimuths(plan.sky.walk.azimuths);
  check_azimuths(plan.links.walk.azimuths);
  auto mips = std::make_unique<HeightMips>(build_height_mips(surface));
  HorizonSky sky = walk_horizon_sky(surface, *mips, plan.sky, {}, limits.watch);
  auto light = std::make_unique<SeenLight>(surface, plan.links, limits);
  if (plan.links.own_share > 0) {
    light->add_own_links(*mips, to_vector(sky.sky_view_factor), plan.links, limits);
  }
  return std::make_unique<HorizonTransport>(std::move(sky), std::move(mips), std::move(light));
}

PlannedTransport plan_horizon_transport(const Surface& surface, const HorizonGoal& goal,
                                        const LinkLimits& limits, const SkyWanted& wanted) {
  if (!(goal.error > 0)) throw UsageError("error", std::to_string(goal.error), "must be positive");
  if (goal.azimuths > 0) check_azimuths(goal.azimuths);
  PlannedTransport planned;
  HorizonPilot pilot(surface, goal.seed, limits.watch);
  planned.plan.sky = plan_sky(pilot, goal);
  auto mips = std::make_unique<HeightMips>(build_height_mips(surface));
  HorizonSky sky = walk_horizon_sky(surface, *mips, planned.plan.sky, {.wanted = wanted}, limits.watch);
  planned.moments = std::move(sky.moments);
  std::unique_ptr<SeenLight> light =
      plan_links(pilot, *mips, to_vector(sky.sky_view_factor), goal, limits, planned.plan);
  planned.transport = std::make_unique<HorizonTransport>(std::move(sky), std::move(mips), std::move(light));
  return planned;
}

}  // namespace heightlight
