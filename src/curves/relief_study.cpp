#include <algorithm>
#include <cmath>

#include "core/progress.h"
#include "heightlight/curves.h"
#include "heightlight/error.h"

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

BounceCurves simulate_curves(Heightmap map, int bounces, int bins) {
  const Surface surface = build_surface(std::move(map));
  const std::unique_ptr<Transport> transport = build_horizon_transport(surface, study_plan(), {});
  CurveBuilder builder(transport->ambient_occlusion, AoKind::ambient_occlusion, bins);
  bounce(
      *transport, surface, bounces, {}, [&](int, const TexelVector& irradiance) { builder.add(irradiance); },
      true);
  return builder.curves();
}

}  // namespace

const HorizonPlan& study_plan() {
  static const HorizonPlan kPlan{{48, 16, 0.3F}, {12, 16, 0.3F}, 1, 0, 0};
  return kPlan;
}

std::vector<ReliefCurves> study_reliefs(const Heightmap& map, const std::vector<double>& relief_shares,
                                        int largest_side, int bounces, int bins, bool quiet) {
  if (largest_side < 1) throw UsageError("a relief study needs a map of at least one texel a side");
  if (bounces < 0) throw UsageError("the number of bounces must not be negative");
  for (const double share : relief_shares) {
    if (!(share > 0) || !std::isfinite(share)) throw UsageError("a relief must be positive and finite");
  }
  const double extent = map.spacing.x * map.height.width;
  const double tall = relief(map);  // of the whole map: what decimation skips must not change the scale
  const Heightmap small = decimate(map, largest_side);
  Progress progress("reliefs", static_cast<std::int64_t>(relief_shares.size()), quiet);
  std::vector<ReliefCurves> study;
  for (const double share : relief_shares) {
    Heightmap scaled = small;
    const double scale = tall > 0 ? share * extent / tall : 1;
    for (float& height : scaled.height.values) height = static_cast<float>(height * scale);
    study.push_back({share, simulate_curves(std::move(scaled), bounces, bins)});
    progress.add(1);
  }
  return study;
}

}  // namespace heightlight
