#include <algorithm>
#include <array>
#include <cmath>

#include "visibility/link_walk.h"

namespace heightlight {
namespace {

using NodeWeights = std::array<float, kMostNodes>;

/// One receiver's walk along one azimuth.
struct LinkWalker {
  float c, n_z, z;
  float slope = 0;
  float cosine = 1;        ///< of the elevation of `slope`
  float seen = 0;          ///< −S(slope), up to a constant: it grows with the slope
  float slope_before = 0;  ///< of the sample before
  float way_before = 0;

  float mass(float m, float q) const { return c * (std::atan(m) + m * q) - n_z * q; }

  float cosine_to_normal(float m, float along) const { return std::max(c * along + n_z * m * along, 0.0F); }

  /// Mean place of a visible stretch, as a share of it; slice_integrals.h has the derivation (mean_share),
  /// here with two nodes. They lie equally far from the middle of the chord between both directions, so that
  /// the squares of their lengths are the same, and cancel.
  float mean_share(float to_slope, float to_cosine, float from_way, float to_way) const {
    const float from_normal = cosine_to_normal(slope, cosine);
    const float to_normal = cosine_to_normal(to_slope, to_cosine);
    float weights = 0;
    float weighted = 0;
    for (const float t : kNodes) {
      const float along = cosine + t * (to_cosine - cosine);
      const float weight = (from_normal + t * (to_normal - from_normal)) * along;
      const float near = t * from_way * to_cosine;
      weights += weight;
      weighted += weight * near / (near + (1 - t) * to_way * cosine);
    }
    return weights > 0 ? weighted / weights : 0.5F;
  }

  void look(float s, float way, const NodeShare& share, NodeWeights& weights) {
    if (s > slope + kLeastRise) {
      const float q = 1 / (1 + s * s);
      const float mass_above = mass(s, q);
      const float weight = mass_above - seen;
      const float to_cosine = std::sqrt(q);
      if (share.splits) {
        // The visible stretch begins where the segment cuts the old line of sight.
        const float below = way_before * (slope - slope_before);
        const float above = way * (s - slope);
        const float begin = below / (below + above);
        const float from_way = way_before + begin * (way - way_before);
        const float beyond = begin + (1 - begin) * mean_share(s, to_cosine, from_way, way);
        const float next = way_before > 0 ? beyond : kOwnFacet;
        weights[share.node] += weight * (1 - next);
        weights[share.node + 1U] += weight * next;
      } else {
        weights[share.node] += weight;
      }
      slope = s;
      cosine = to_cosine;
      seen = mass_above;
    }
    slope_before = s;
    way_before = way;
  }
};

void walk(const WalkTile& tile, const LinkAzimuth& azimuth, int i, int j, NodeWeights& weights) {
  const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
  const int row = tile.first_row + i;
  const int column = tile.first_column + j;
  LinkWalker walker{};
  walker.n_z = tile.normal_z[at];
  walker.z = tile.height[at];
  walker.slope = tile.slope_x[at] * azimuth.walk.world_x + tile.slope_y[at] * azimuth.walk.world_y;
  walker.c = -walker.n_z * walker.slope;
  const float q = 1 / (1 + walker.slope * walker.slope);
  walker.cosine = std::sqrt(q);
  walker.seen = walker.mass(walker.slope, q);
  for (std::size_t k = 0; k < azimuth.walk.near.size(); ++k) {
    const NearSample& sample = azimuth.walk.near[k];
    const HeightWindow& window = k < azimuth.walk.lifted ? tile.windows[0] : tile.lifted;
    const float weighted = sample.weight[0] * window.at(row + sample.row[0], column + sample.column[0]) +
                           sample.weight[1] * window.at(row + sample.row[1], column + sample.column[1]);
    walker.look(weighted - sample.per_distance * walker.z, sample.way, azimuth.light.near[k], weights);
  }
  for (std::size_t ring = 0; ring < azimuth.walk.rings.size(); ++ring) {
    const HeightWindow& window = tile.windows[ring + 1];
    for (std::size_t k = 0; k < azimuth.walk.rings[ring].size(); ++k) {
      const RingSample& sample = azimuth.walk.rings[ring][k];
      const float height =
          window.at((row + sample.row) >> window.level, (column + sample.column) >> window.level);
      walker.look((height - walker.z) * sample.per_distance, sample.way, azimuth.light.rings[ring][k],
                  weights);
    }
  }
}

}  // namespace

std::vector<LinkAzimuth> make_link_azimuths(const Surface& surface, const WalkOptions& options) {
  std::vector<LinkAzimuth> azimuths;
  for (int k = 0; k < options.azimuths; ++k) {
    LinkAzimuth azimuth{make_azimuth_table(surface, options, azimuth_rad(options, k)), {}};
    azimuth.light = make_light_table(surface, options, k, azimuth.walk);
    azimuths.push_back(std::move(azimuth));
  }
  return azimuths;
}

BlockSet all_blocks(const TileFrame& tile) {
  BlockSet blocks;
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += kBlock) blocks.set(block_index(row, column));
  }
  return blocks;
}

void walk_links_scalar(const WalkTile& tile, const std::vector<LinkAzimuth>& azimuths, const BlockSet& blocks,
                       std::vector<std::uint8_t>& stream) {
  std::vector<NodeWeights> weights(kBlock);
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += kBlock) {
      if (!blocks[block_index(row, column)]) continue;
      std::array<float, kBlock> sum{};    // of weights so far, in steps
      std::array<float, kBlock> given{};  // whole steps
      for (const LinkAzimuth& azimuth : azimuths) {
        for (int lane = 0; lane < kBlock; ++lane) {
          weights[static_cast<std::size_t>(lane)].fill(0);
          walk(tile, azimuth, row, column + lane, weights[static_cast<std::size_t>(lane)]);
        }
        const std::size_t counts = stream.size();
        stream.insert(stream.end(), 2, 0);
        for (std::size_t node = 0; node < azimuth.light.nodes.size(); ++node) {
          std::array<std::uint8_t, kEntryBytes> entry{static_cast<std::uint8_t>(node)};
          bool any = false;
          for (std::size_t lane = 0; lane < kBlock; ++lane) {
            sum[lane] += weights[lane][node] * kQuantum;
            const float steps = std::max(std::nearbyint(sum[lane]) - given[lane], 0.0F);
            given[lane] += steps;
            entry[1 + lane] = static_cast<std::uint8_t>(std::min(steps, 255.0F));
            any = any || steps > 0;
          }
          if (!any) continue;
          stream.insert(stream.end(), entry.begin(), entry.end());
          ++stream[counts + (static_cast<int>(node) < azimuth.light.near_nodes ? 0 : 1)];
        }
      }
    }
  }
}

}  // namespace heightlight
