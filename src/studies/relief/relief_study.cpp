#include "relief/relief_study.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/progress.h"
#include "heightlight/error.h"
#include "heightlight/solve.h"

namespace heightlight {
namespace {

/// Every n-th sample from the first on, over the same extent. Where n does not divide a side the places are
/// rounded down, so that a tile's period stays whole.
Heightmap decimate(const Heightmap& map, int largest_side) {
  const int width = map.height.width;
  const int height = map.height.height;
  const int n = (std::max(width, height) + largest_side - 1) / largest_side;
  Heightmap copy = map;
  copy.height = Image<float>(std::max(1, width / n), std::max(1, height / n));
  const auto source = [](int i, int from, int to) { return static_cast<int>(std::int64_t{i} * from / to); };
  for (int row = 0; row < copy.height.height; ++row) {
    for (int column = 0; column < copy.height.width; ++column) {
      copy.height(row, column) =
          map.height(source(row, height, copy.height.height), source(column, width, copy.height.width));
    }
  }
  copy.spacing.x *= static_cast<double>(width) / copy.height.width;
  copy.spacing.y *= static_cast<double>(height) / copy.height.height;
  return copy;
}

/// Curves over α of whatever bounces come.
class AlphaCurves : public BounceSink {
 public:
  explicit AlphaCurves(int bins) : bins_(bins) {}

  void take_sky(const Map& ambient_occlusion, const Map&) override {
    builder_.emplace(ambient_occlusion, AoKind::ambient_occlusion, bins_);
  }
  void take_bounce(int, const TexelVector& irradiance) override { builder_->add(irradiance); }
  void take_tail(const TexelVector&) override {}

  const BounceCurves& curves() const { return builder_->curves(); }

 private:
  int bins_;
  std::optional<CurveBuilder> builder_;
};

BounceCurves simulate_curves(Heightmap map, const ReliefStudy& study, const Watch& watch) {
  const Surface surface = build_surface(std::move(map));
  AlphaCurves curves(study.bins);
  Request request;
  request.wanted.bounces = study.bounces;
  request.accuracy.plan = study_plan();
  request.checks = {.sky = false, .totals = false, .energy = false, .bounces = false};
  request.watch = {.tell = {}, .stopped = watch.stopped};
  request.sink = &curves;
  solve(surface, request);
  return curves.curves();
}

}  // namespace

const HorizonPlan& study_plan() {
  static const HorizonPlan kPlan{
      .sky = {.walk = {.azimuths = 48, .samples_per_octave = 16, .peak_share = 0.3F}},
      .gather = {.walk = {.azimuths = 8, .samples_per_octave = 16, .peak_share = 0.3F}},
  };
  return kPlan;
}

std::vector<ReliefCurves> study_reliefs(const Heightmap& map, const ReliefStudy& study, const Watch& watch) {
  if (study.largest_side < 1) throw UsageError("a relief study needs a map of at least one texel a side");
  if (study.bounces < 1) throw UsageError("bounces", std::to_string(study.bounces), "must be at least one");
  for (const double share : study.relief_shares) {
    if (!(share > 0) || !std::isfinite(share))
      throw UsageError("relief_share", "", "must be positive and finite");
  }
  const double extent = map.spacing.x * map.height.width;
  const double tall = relief(map);  // of the whole map: what decimation skips must not change the scale
  const Heightmap small = decimate(map, study.largest_side);
  Progress progress("reliefs", static_cast<std::int64_t>(study.relief_shares.size()), watch);
  std::vector<ReliefCurves> results;
  for (const double share : study.relief_shares) {
    Heightmap scaled = small;
    const double scale = tall > 0 ? share * extent / tall : 1;
    for (float& height : scaled.height.values) height = static_cast<float>(height * scale);
    scaled.curvature *= scale;
    results.push_back({.relief_share = share,
                       .curves = simulate_curves(std::move(scaled), study, watch),
                       .width = small.height.width,
                       .height = small.height.height});
    progress.add(1);
  }
  return results;
}

}  // namespace heightlight
