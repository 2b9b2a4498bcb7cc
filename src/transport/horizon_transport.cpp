#include <cmath>
#include <string>

#include "core/parallel.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/horizon_links.h"
#include "transport/horizon_plan.h"
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
  HorizonTransport(const Surface& surface, HorizonSky sky, const HorizonPlan& plan,
                   const HorizonOptions& options)
      : mips_(build_height_mips(surface)),
        links_(surface, mips_, plan.links, options.memory_limit, options.quiet) {
    ambient_occlusion = std::move(sky.ambient_occlusion);
    sky_view_factor = std::move(sky.sky_view_factor);
    direct = to_vector(sky_view_factor);
  }

  TexelVector gather(const TexelVector& x) const override {
    TexelVector result(x.size());
    links_.gather(x, direct, result);
    return result;
  }

  /// Gathers are made in single precision.
  double solver_tolerance() const override { return 1e-6; }
  std::uint64_t link_count() const override { return links_.entries() * kBlock; }
  std::uint64_t bytes() const override { return links_.bytes(); }

 private:
  HeightMips mips_;
  mutable HorizonLinks links_;  ///< gathers change nothing but its buffer of light
};

}  // namespace

std::unique_ptr<Transport> build_horizon_transport(const Surface& surface, const HorizonPlan& plan,
                                                   const HorizonOptions& options) {
  check_azimuths(plan.sky.azimuths);
  check_azimuths(plan.links.azimuths);
  HorizonSky sky = walk_horizon_sky(surface, build_height_mips(surface), plan.sky, options.quiet);
  return std::make_unique<HorizonTransport>(surface, std::move(sky), plan, options);
}

PlannedTransport plan_horizon_transport(const Surface& surface, double error, int azimuths,
                                        std::uint64_t seed, const HorizonOptions& options) {
  if (!(error > 0)) throw UsageError("--error " + std::to_string(error) + ": must be positive");
  if (azimuths > 0) check_azimuths(azimuths);
  PlannedTransport planned;
  HorizonPilot pilot(surface, seed);
  planned.plan = plan_sky(pilot, error, azimuths);
  HorizonSky sky = walk_horizon_sky(surface, build_height_mips(surface), planned.plan.sky, options.quiet);
  {
    const TexelVector direct = to_vector(sky.sky_view_factor);
    LightMips light(surface);
    light.fill(direct);
    plan_links(pilot, light, direct, error, planned.plan);
  }
  planned.transport = std::make_unique<HorizonTransport>(surface, std::move(sky), planned.plan, options);
  return planned;
}

}  // namespace heightlight
