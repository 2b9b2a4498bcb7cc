#include "visibility/horizon_means.h"

#include <limits>

#include "base/texel_algebra.h"

namespace heightlight {
namespace {

/// What a thread needs to walk tile after tile.
struct MeansWorkspace {
  WalkTile tile;
  HorizonSums sums;
  FarView far;
};

void walk(const Route& route, MeansWorkspace& work) {
  for (auto& sums : work.sums.of) sums.fill(0);
  for (const RouteAzimuth& azimuth : route.azimuths) {
    if (azimuth.maximum_distance) {
      add_horizons_within(work.tile, azimuth.table, *azimuth.maximum_distance, work.sums);
    } else {
      look_far(work.tile, azimuth.table, work.far);
      add_horizons(work.tile, azimuth.table, work.far, work.sums);
    }
  }
}

}  // namespace

std::vector<Map> walk_horizon_means(const Surface& surface, const HeightPyramid& pyramid,
                                    const WalkOptions& options, const std::vector<HorizonMean>& means,
                                    const std::optional<MaximumDistance>& maximum_distance,
                                    const Watch& watch) {
  const Route route = plan_route(surface, options, walked_azimuths(options), maximum_distance);
  const std::vector<TileFrame> tiles = all_tiles(surface);
  const RouteStep step{.route = route, .tiles = tiles, .label = "horizons", .watch = watch};
  std::vector<Map> found(means.size(),
                         Map(surface.width(), surface.height(), std::numeric_limits<float>::quiet_NaN()));
  const auto count = static_cast<float>(options.azimuths);
  for_tiles<MeansWorkspace>(surface, pyramid, options, step, [&](MeansWorkspace& work, std::size_t) {
    walk(route, work);
    for_present(work.tile, [&](std::size_t at, int row, int column) {
      for (std::size_t k = 0; k < means.size(); ++k)
        found[k](row, column) = work.sums.of[static_cast<std::size_t>(means[k])][at] / count;
    });
  });
  return found;
}

std::vector<HorizonBlock> walk_horizon_blocks(const Surface& surface, const HeightPyramid& pyramid,
                                              const WalkOptions& options,
                                              const std::vector<TileFrame>& blocks,
                                              const std::optional<MaximumDistance>& maximum_distance,
                                              const Watch& watch) {
  const Route route = plan_route(surface, options, walked_azimuths(options), maximum_distance);
  const RouteStep step{.route = route, .tiles = blocks, .label = "trial", .watch = watch};
  std::vector<HorizonBlock> found(blocks.size());
  const auto count = static_cast<float>(options.azimuths);
  for_tiles<MeansWorkspace>(surface, pyramid, options, step, [&](MeansWorkspace& work, std::size_t block) {
    walk(route, work);
    for (std::size_t k = 0; k < kHorizonMeans; ++k) {
      for (int i = 0; i < blocks[block].rows; ++i) {
        for (int j = 0; j < blocks[block].columns; ++j)
          found[block][k][static_cast<std::size_t>(i * WalkTile::kWideGroup + j)] =
              work.sums.of[k][static_cast<std::size_t>(i * WalkTile::kSide + j)] / count;
      }
    }
  });
  return found;
}

std::vector<HorizonTerms<double>> exact_horizon_terms(const ExactWalker& walker, int row, int column) {
  const Eigen::Vector3d normal = as_eigen(walker.surface().normal(row, column)).cast<double>();
  std::vector<HorizonTerms<double>> terms;
  for (int k = 0; k < walker.azimuths(); ++k) {
    const Eigen::Vector2d azimuth(std::cos(walker.azimuth_rad(k)), std::sin(walker.azimuth_rad(k)));
    const double level = walker.level_slope(row, column, azimuth);
    const double tangent = -normal.head<2>().dot(azimuth) / normal.z();
    terms.push_back(horizon_terms(walker.horizon_slope(row, column, azimuth) - level, tangent - level));
  }
  return terms;
}

HorizonTerms<double> exact_horizon_means(const ExactWalker& walker, int row, int column) {
  HorizonTerms<double> means{};
  for (const HorizonTerms<double>& terms : exact_horizon_terms(walker, row, column)) {
    for (std::size_t k = 0; k < kHorizonMeans; ++k) means[k] += terms[k] / walker.azimuths();
  }
  return means;
}

}  // namespace heightlight
