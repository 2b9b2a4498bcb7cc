#include <cmath>
#include <string>

#include "base/texels.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/field_gather.h"
#include "transport/horizon_plan.h"
#include "transport/progressive_gather.h"
#include "transport/walked_bounces.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

TexelVector to_vector(const Map& map) {
  TexelVector values(map.size());
  for_texels(map, [&](std::size_t i) { values[i] = std::isnan(map.values[i]) ? 0 : double{map.values[i]}; });
  return values;
}

/// Fewest samples per octave for single bounces: late bounces remain in narrow places, which coarse walks
/// miss.
constexpr int kBounceFineness = 16;

class HorizonTransport : public Transport {
 public:
  HorizonTransport(HorizonSky found, PlannedGather planned, double error, const Watch& watch)
      : plan_(planned.plan), gather_(std::move(planned.gather)), error_(error), watch_(watch) {
    ambient_occlusion = std::move(found.ambient_occlusion);
    sky_view_factor = std::move(found.sky_view_factor);
    direct = to_vector(sky_view_factor);
  }

  TexelVector gather(const TexelVector& x) const override {
    return gather_field(field_gather(), x, {plan_.walk.azimuths, 0.25});
  }

  TexelVector surface_share() const override {
    return find_surface_share(field_gather(), {plan_.first_bounce_azimuths, 0.25});
  }

  std::unique_ptr<BounceSequence> start_bounces() const override {
    const BounceWalk walk{.azimuths = plan_.first_bounce_azimuths, .error = error_};
    std::shared_ptr<const MapGather> gather = gather_;
    if (plan_.walk.samples_per_octave < kBounceFineness) {
      WalkOptions finer = plan_.walk;
      finer.samples_per_octave = kBounceFineness;
      gather =
          std::make_shared<MapGather>(gather_->surface(), build_height_pyramid(gather_->surface()), finer);
    }
    return std::make_unique<WalkedBounces>(std::move(gather), *this, walk, watch_);
  }

  Totals solve(const std::vector<IrradianceSystem>& systems, const Watch& watch) const override {
    const ProgressiveGoal goal{
        .error = error_, .last_azimuths = plan_.walk.azimuths, .planned_unevenness = plan_.unevenness};
    ProgressiveSolution solution = gather_progressively(*gather_, sky_view_factor, systems, goal, watch);
    return {.irradiance = std::move(solution.irradiance), .gathers = solution.gathers};
  }

  std::uint64_t link_count() const override { return 0; }
  std::uint64_t bytes() const override { return 0; }

 private:
  FieldGather field_gather() const { return {*gather_, sky_view_factor, direct, watch_}; }

  GatherPlan plan_;
  std::shared_ptr<const MapGather> gather_;
  double error_;
  Watch watch_;  ///< asked by gathers whether to go on
};

}  // namespace

void check_horizon_plan(const HorizonPlan& plan) {
  constexpr int kMostGathered = 4096;
  constexpr int kFinest = 128;
  check_azimuths(plan.sky.walk.azimuths);
  if (plan.sky.full_from > 0 && plan.sky.walk.azimuths % 4 != 0) {
    throw UsageError("azimuths", std::to_string(plan.sky.walk.azimuths),
                     "must be a multiple of 4 where open ground walks every other one");
  }
  for (const int azimuths : {plan.gather.walk.azimuths, plan.gather.first_bounce_azimuths}) {
    check_azimuths(azimuths);
    if (azimuths > kMostGathered) {
      throw UsageError("azimuths", std::to_string(azimuths),
                       "of gathers must be " + std::to_string(kMostGathered) + " at most");
    }
  }
  for (const WalkOptions& walk : {plan.sky.walk, plan.gather.walk}) {
    if (walk.samples_per_octave < 1 || walk.samples_per_octave > kFinest)
      throw UsageError("fineness", std::to_string(walk.samples_per_octave), "must be from 1 to 128");
    if (!(walk.peak_share >= 0 && walk.peak_share <= 1))
      throw UsageError("peak_share", std::to_string(walk.peak_share), "must be from 0 to 1");
  }
}

std::unique_ptr<Transport> build_horizon_transport(const Surface& surface, const HorizonPlan& plan,
                                                   double error, const Watch& watch) {
  if (!(error > 0)) throw UsageError("error", std::to_string(error), "must be positive");
  check_horizon_plan(plan);
  const HeightPyramid pyramid = build_height_pyramid(surface);
  HorizonSky sky = walk_horizon_sky(surface, pyramid, plan.sky, {}, watch);
  PlannedGather planned{.plan = plan.gather,
                        .gather = std::make_unique<MapGather>(surface, pyramid, plan.gather.walk)};
  return std::make_unique<HorizonTransport>(std::move(sky), std::move(planned), error, watch);
}

PlannedTransport plan_horizon_transport(const Surface& surface, const HorizonGoal& goal,
                                        const SkyWanted& wanted, const Watch& watch) {
  if (!(goal.error > 0)) throw UsageError("error", std::to_string(goal.error), "must be positive");
  if (goal.azimuths > 0) check_azimuths(goal.azimuths);
  PlannedTransport planned;
  const HeightPyramid pyramid = build_height_pyramid(surface);
  GatherCalibration calibration(surface, {.seed = goal.seed, .watch = watch});
  PlannedSky sky = find_sky_for_totals(pyramid, goal, wanted, calibration, watch);
  PlannedGather gather = plan_gather(calibration, pyramid, goal.error, sky);
  planned.plan = {.sky = sky.plan, .gather = gather.plan};
  planned.moments = std::move(sky.sky.moments);
  planned.transport =
      std::make_unique<HorizonTransport>(std::move(sky.sky), std::move(gather), goal.error, watch);
  return planned;
}

}  // namespace heightlight
