#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "screenspace/bilateral_gather.h"

namespace heightlight {
namespace {

/// Index along an axis, wrapped on a tiling map; −1 outside an open map.
int find(int i, int count, Boundary boundary) {
  if (i >= 0 && i < count) return i;
  return boundary == Boundary::tile ? ((i % count) + count) % count : -1;
}

/// Calls add(i, j) for the texels of the window that lie on the receiver's surface.
template <class Add>
void for_neighbours(const GatherPass& pass, int row, int column, Add&& add) {
  const DepthBuffer& depth = pass.depth;
  for (int down = -kGatherBefore; down <= kGatherAfter; ++down) {
    for (int right = -kGatherBefore; right <= kGatherAfter; ++right) {
      const int i = find(row + down, depth.height, depth.boundary);
      const int j = find(column + right, depth.width, depth.boundary);
      if (i < 0 || j < 0) continue;
      const float x = static_cast<float>(right * depth.spacing.x);
      const float y = static_cast<float>(-down * depth.spacing.y);  // rows run down, y up
      const NeighbourPlace place{.row = i, .column = j, .x = x, .y = y};
      if (on_same_surface(depth, row, column, place, {.distance = pass.tolerance, .cosine = pass.cosine}))
        add(i, j);
    }
  }
}

}  // namespace

void gather_row_scalar(const GatherPass& pass, int row, int begin, int end, std::vector<Map>& means) {
  for (int column = begin; column < end; ++column) {
    if (std::isnan(pass.depth.row_height(row, column))) {
      for (Map& mean : means) mean(row, column) = std::numeric_limits<float>::quiet_NaN();
      continue;
    }
    float count = 0;
    for (Map& mean : means) mean(row, column) = 0;
    for_neighbours(pass, row, column, [&](int i, int j) {
      ++count;
      for (std::size_t c = 0; c < means.size(); ++c) means[c](row, column) += pass.results[c](i, j);
    });
    for (Map& mean : means) mean(row, column) /= count;
  }
}

std::vector<Map> gather_bilaterally(const DepthBuffer& depth, const std::vector<Map>& results) {
  std::vector<Map> means(results.size(), Map(depth.width, depth.height));
  const double texel = std::sqrt(depth.spacing.x * depth.spacing.y);
  const GatherPass pass{depth, results, static_cast<float>(kGatherTolerance * texel)};
  parallel_for(depth.height, [&](std::int64_t row) { gather_row(pass, static_cast<int>(row), means); });
  return means;
}

}  // namespace heightlight
