#include "terrain/horizon_march.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "base/parallel.h"

namespace heightlight {
namespace {

/// From a texel to the cell that is nearest to a place on its ray.
struct MarchStep {
  int columns = 0;
  int rows = 0;
  float per_distance = 0;
};

std::vector<MarchStep> list_steps(const Surface& surface, const MarchOptions& options) {
  const Spacing& spacing = surface.map.spacing;
  const double length = std::min(spacing.x, spacing.y);
  const double along_columns = std::cos(options.azimuth_rad) * length / spacing.x;
  const double along_rows = -std::sin(options.azimuth_rad) * length / spacing.y;
  std::vector<MarchStep> steps;
  for (int k = 1; options.cells == 0 || k <= options.cells; ++k) {
    const int columns = static_cast<int>(std::floor(k * along_columns + 0.5));
    const int rows = static_cast<int>(std::floor(k * along_rows + 0.5));
    if (std::abs(columns) >= surface.width() || std::abs(rows) >= surface.height()) break;
    const double distance = options.distance == CellDistance::along_ray
                                ? k * length
                                : std::hypot(columns * spacing.x, rows * spacing.y);
    steps.push_back({columns, rows, static_cast<float>(1 / distance)});
  }
  return steps;
}

void march_row(const Surface& surface, const std::vector<MarchStep>& steps, int row, float* steepest) {
  const Image<float>& height = surface.map.height;
  const float* here = height.values.data() + height.index(row, 0);
  for (const MarchStep& step : steps) {
    const int seen_row = row + step.rows;
    if (seen_row < 0 || seen_row >= height.height) break;
    const float* seen = height.values.data() + height.index(seen_row, 0);
    const int begin = std::max(0, -step.columns);
    const int end = std::min(height.width, height.width - step.columns);
    const float per_distance = step.per_distance;
    const int columns = step.columns;
    for (int i = begin; i < end; ++i) {
      const float slope = (seen[i + columns] - here[i]) * per_distance;
      steepest[i] = slope > steepest[i] ? slope : steepest[i];  // not where either is missing
    }
  }
}

}  // namespace

Map march_horizon(const Surface& surface, const MarchOptions& options) {
  assert(!surface.tiles() && options.cells >= 0);
  const std::vector<MarchStep> steps = list_steps(surface, options);
  Map slopes(surface.width(), surface.height(), -std::numeric_limits<float>::infinity());
  parallel_for(surface.height(), [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    march_row(surface, steps, row, slopes.values.data() + slopes.index(row, 0));
    for (int column = 0; column < surface.width(); ++column) {
      if (std::isnan(surface.map.height(row, column)))
        slopes(row, column) = std::numeric_limits<float>::quiet_NaN();
    }
  });
  return slopes;
}

}  // namespace heightlight
