#include <algorithm>
#include <cmath>
#include <string>

#include "base/texel_algebra.h"
#include "base/texels.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/horizon_plan.h"
#include "transport/progressive_gather.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

TexelVector to_vector(const Map& map) {
  TexelVector values(map.size());
  for_texels(map, [&](std::size_t i) { values[i] = std::isnan(map.values[i]) ? 0 : double{map.values[i]}; });
  return values;
}

/// The power of two by which light that single precision might lose is gathered brighter.
int dimness(const TexelVector& x) {
  constexpr int kDimmest = -40;
  int exponent = 0;
  const double brightest = as_eigen(x).cwiseAbs().maxCoeff();
  std::frexp(brightest, &exponent);
  if (brightest == 0 || exponent >= kDimmest) return 0;
  return std::max(exponent, -1000);  // of what is dimmer still the power would be infinite
}

class HorizonTransport : public Transport {
 public:
  HorizonTransport(HorizonSky found, PlannedGather planned, double error, const Watch& watch)
      : plan_(planned.plan), gather_(std::move(planned.gather)), error_(error), watch_(watch) {
    ambient_occlusion = std::move(found.ambient_occlusion);
    sky_view_factor = std::move(found.sky_view_factor);
    direct = to_vector(sky_view_factor);
  }

  TexelVector gather(const TexelVector& x) const override { return gather(x, {plan_.walk.azimuths, 0.25}); }

  TexelVector next_bounce(const TexelVector& before, int bounce) const override {
    // What is left falls from bounce to bounce, and with it what few azimuths cost. No bounce sees another
    // gather of the same light, as the last two of a total do: the first walks as many azimuths as both
    // together. Curves show what is left on a logarithmic scale: late bounces, too, need a few.
    constexpr int kFewest = 4;
    const int first = 2 * plan_.walk.azimuths;
    const int azimuths = even_azimuths(std::max(first / bounce, std::min(first, kFewest)));
    return gather(before, {azimuths, golden_turn(bounce)});
  }

  Totals solve(const std::vector<LightSystem>& systems, const Watch& watch) const override {
    const ProgressiveGoal goal{.error = error_, .last_azimuths = plan_.walk.azimuths};
    ProgressiveSolution solution = gather_progressively(*gather_, sky_view_factor, systems, goal, watch);
    return {.irradiance = std::move(solution.irradiance), .gathers = solution.gathers};
  }

  std::uint64_t link_count() const override { return 0; }
  std::uint64_t bytes() const override { return 0; }

 private:
  TexelVector gather(const TexelVector& x, GatherTurn turn) const {
    turn.sky = &sky_view_factor;
    const int exponent = dimness(x);
    Map field(sky_view_factor.width, sky_view_factor.height);
    for_texels(field, [&](std::size_t i) {
      const bool missing = std::isnan(sky_view_factor.values[i]);
      field.values[i] = missing ? sky_view_factor.values[i] : static_cast<float>(std::ldexp(x[i], -exponent));
    });
    FieldPyramid pyramid = gather_->make_pyramid();
    pyramid.fill(field);
    TexelVector result(x.size());
    gather_->run(
        turn, {&pyramid},
        [&](const ReceiverTile& tile, const GatherSums& sums) {
          for (int row = 0; row < tile.rows; ++row) {
            for (int column = 0; column < tile.columns; ++column) {
              const auto at = static_cast<std::size_t>(row * ReceiverTile::kSide + column);
              if (!tile.present[at]) continue;
              const std::size_t i = field.index(tile.first_row + row, tile.first_column + column);
              // Who sees nothing along these azimuths, but has A < 1, sees its like.
              const double seen = sums.weight[at] > 0 ? double{sums.weighted[0][at]} / double{sums.weight[at]}
                                                      : double{field.values[i]};
              result[i] = std::ldexp((1 - direct[i]) * seen, exponent);
            }
          }
        },
        watch_);
    return result;
  }

  GatherPlan plan_;
  std::unique_ptr<MapGather> gather_;
  double error_;
  Watch watch_;  ///< asked by gathers whether to go on
};

}  // namespace

std::unique_ptr<Transport> build_horizon_transport(const Surface& surface, const HorizonPlan& plan,
                                                   double error, const Watch& watch) {
  if (!(error > 0)) throw UsageError("error", std::to_string(error), "must be positive");
  check_azimuths(plan.sky.walk.azimuths);
  check_azimuths(plan.gather.walk.azimuths);
  const HeightMips mips = build_height_mips(surface);
  HorizonSky sky = walk_horizon_sky(surface, mips, plan.sky, {}, watch);
  PlannedGather planned{.plan = plan.gather,
                        .gather = std::make_unique<MapGather>(surface, mips, plan.gather.walk)};
  return std::make_unique<HorizonTransport>(std::move(sky), std::move(planned), error, watch);
}

PlannedTransport plan_horizon_transport(const Surface& surface, const HorizonGoal& goal,
                                        const SkyWanted& wanted, const Watch& watch) {
  if (!(goal.error > 0)) throw UsageError("error", std::to_string(goal.error), "must be positive");
  if (goal.azimuths > 0) check_azimuths(goal.azimuths);
  PlannedTransport planned;
  HorizonPilot pilot(surface, goal.seed, watch);
  planned.plan.sky = plan_sky(pilot, goal);
  const HeightMips mips = build_height_mips(surface);
  HorizonSky sky = walk_horizon_sky(surface, mips, planned.plan.sky, {.wanted = wanted}, watch);
  planned.moments = std::move(sky.moments);
  PlannedGather gather = plan_gather(pilot, mips, sky.sky_view_factor, goal, planned.plan.sky);
  planned.plan.gather = gather.plan;
  planned.transport =
      std::make_unique<HorizonTransport>(std::move(sky), std::move(gather), goal.error, watch);
  return planned;
}

}  // namespace heightlight
