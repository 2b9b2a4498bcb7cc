#include "visibility/light_nodes.h"

#include <algorithm>
#include <cmath>

namespace heightlight {
namespace {

/// Way of the last near node, and nodes an octave beyond it.
int near_way(const WalkOptions& options) { return 2 * options.fineness; }
int per_octave(const WalkOptions& options) { return options.fineness; }

/// The receiver and the walk's samples up to `way`.
void add_near_nodes(const AzimuthTable& walk, int way, LightTable& table) {
  table.nodes.push_back({});
  for (const NearSample& sample : walk.near) {
    if (sample.way >= static_cast<float>(way)) break;
    LightNode node;
    std::copy_n(sample.row, 2, node.row);
    std::copy_n(sample.column, 2, node.column);
    node.share = sample.weight[1] / sample.per_distance;
    table.nodes.push_back(node);
  }
  table.near_nodes = static_cast<int>(table.nodes.size());
}

void add_far_nodes(const GridDirection& g, int octave, double farthest, LightTable& table) {
  const auto fits = [&] { return table.nodes.size() + static_cast<std::size_t>(octave) <= kMostNodes; };
  for (int level = 1; std::ldexp(octave, level) <= farthest && fits(); ++level) {
    for (int i = 0; i < octave; ++i) {
      const double t = std::ldexp(octave + i + 0.5, level);
      LightNode node;
      node.level = level;
      node.row[0] = node.row[1] = static_cast<int>(std::lround(t * g.v));
      node.column[0] = node.column[1] = static_cast<int>(std::lround(t * g.u));
      table.nodes.push_back(node);
    }
  }
}

/// The far node whose ring of ways holds t, or the last near one.
NodeShare far_share(const LightTable& table, int octave, double t) {
  if (t < 2 * octave) return {static_cast<std::uint8_t>(table.near_nodes - 1), false};
  const int level = static_cast<int>(std::floor(std::log2(t / octave)));
  const int step = static_cast<int>(std::ldexp(t, -level)) - octave;
  const int node = table.near_nodes + (level - 1) * octave + step;
  return {static_cast<std::uint8_t>(std::min(node, static_cast<int>(table.nodes.size()) - 1)), false};
}

}  // namespace

LightTable make_light_table(const Surface& surface, const WalkOptions& options, int k,
                            const AzimuthTable& walk) {
  const GridDirection g = grid_direction(surface, azimuth_rad(options, k));
  LightTable table;
  const int octave = per_octave(options);
  const double farthest = walk.rings.empty() ? 4.0 * options.fineness : double{walk.rings.back().back().way};
  add_near_nodes(walk, near_way(options), table);
  add_far_nodes(g, octave, farthest, table);
  double before = 0;
  for (std::size_t i = 0; i < walk.near.size(); ++i) {
    const double middle = 0.5 * (before + walk.near[i].way);
    const bool between_near = static_cast<int>(i) + 1 < table.near_nodes;
    table.near.push_back(between_near ? NodeShare{static_cast<std::uint8_t>(i), true}
                                      : far_share(table, octave, middle));
    before = walk.near[i].way;
  }
  for (const std::vector<RingSample>& ring : walk.rings) {
    table.rings.emplace_back();
    for (const RingSample& sample : ring)
      table.rings.back().push_back(far_share(table, octave, double{sample.way}));
  }
  return table;
}

}  // namespace heightlight
