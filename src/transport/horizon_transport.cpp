#include <cmath>
#include <string>

#include "core/parallel.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/horizon_plan.h"
#include "transport/seen_light.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

TexelVector to_vector(const Map& map) {
  TexelVector values(static_cast<Eigen::Index>(map.size()));
  parallel_for(map.height, [&](std::int64_t row) {
    for (std::int64_t i = row * map.width; i < (row + 1) * map.width; ++i) {
      const float value = map.values[static_cast<std::size_t>(i)];
      values[i] = std::isnan(value) ? 0 : double{value};
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
                                                   const HorizonOptions& options) {
  check_azimuths(plan.sky.azimuths);
  check_azimuths(plan.links.azimuths);
  auto mips = std::make_unique<HeightMips>(build_height_mips(surface));
  HorizonSky sky = walk_horizon_sky(surface, *mips, plan.sky, options.quiet, {{}, {}, plan.sky_full_from});
  auto light = std::make_unique<SeenLight>(surface, plan, options);
  if (plan.own_share > 0) light->add_own_links(*mips, to_vector(sky.sky_view_factor), plan, options);
  return std::make_unique<HorizonTransport>(std::move(sky), std::move(mips), std::move(light));
}

PlannedTransport plan_horizon_transport(const Surface& surface, const HorizonGoal& goal,
                                        const HorizonOptions& options, const SkyWanted& wanted) {
  if (!(goal.error > 0)) throw UsageError("--error " + std::to_string(goal.error) + ": must be positive");
  if (goal.azimuths > 0) check_azimuths(goal.azimuths);
  PlannedTransport planned;
  HorizonPilot pilot(surface, goal.seed);
  planned.plan = plan_sky(pilot, goal);
  auto mips = std::make_unique<HeightMips>(build_height_mips(surface));
  HorizonSky sky = walk_horizon_sky(surface, *mips, planned.plan.sky, options.quiet,
                                    {wanted, {}, planned.plan.sky_full_from});
  planned.moments = std::move(sky.moments);
  std::unique_ptr<SeenLight> light =
      plan_links(pilot, *mips, to_vector(sky.sky_view_factor), goal, options, planned.plan);
  planned.transport = std::make_unique<HorizonTransport>(std::move(sky), std::move(mips), std::move(light));
  return planned;
}

}  // namespace heightlight
