#include "window/coarse_levels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/blocks.h"
#include "surface/occluders.h"
#include "visibility/field_levels.h"
#include "window/read_around.h"

namespace heightlight {
namespace {

bool has_holes(const Map& map) {
  return std::any_of(map.values.begin(), map.values.end(), [](float value) { return std::isnan(value); });
}

/// Without its outermost samples.
Map without_border(const Map& map) {
  Map inner(map.width - 2, map.height - 2);
  for (int row = 0; row < inner.height; ++row) std::copy_n(&map(row + 1, 1), inner.width, &inner(row, 0));
  return inner;
}

Map coarsened(Map& fine) {
  Map coarse(half_blocks(fine.width), half_blocks(fine.height));
  coarsen_field(view_of(fine), view_of(coarse));
  return coarse;
}

}  // namespace

CoarseHeights complete_heights(int first, HeightPyramid::Level finest) {
  CoarseHeights coarse{.first = first, .levels = {}};
  coarse.levels.push_back(std::move(finest));
  while (coarse.levels.back().mean.size() > 1) {
    HeightPyramid::Level next = coarsen_heights(coarse.levels.back().mean, coarse.levels.back().highest);
    coarse.levels.push_back(std::move(next));
  }
  return coarse;
}

CoarseField complete_field(int first, Map finest) {
  CoarseField coarse{.first = first, .levels = {}};
  coarse.levels.push_back(std::move(finest));
  while (coarse.levels.back().size() > 1) coarse.levels.push_back(coarsened(coarse.levels.back()));
  fill_field_holes(view_of(coarse.levels.back()), nullptr);
  for (std::size_t k = coarse.levels.size() - 1; k-- > 0;) {
    const FieldView parents = view_of(coarse.levels[k + 1]);
    fill_field_holes(view_of(coarse.levels[k]), &parents);
  }
  return coarse;
}

Map read_occluders(const StoredMap& heights, Boundary boundary, const MapRect& rect) {
  const MapRect wider{rect.first_row - 1, rect.first_column - 1, rect.rows + 2, rect.columns + 2};
  Map samples = read_around(heights, boundary, wider);
  if (!has_holes(samples)) return without_border(samples);
  Surface part;
  part.map.height = std::move(samples);
  part.map.boundary = Boundary::open;
  return without_border(occluding_heights(part));
}

HeightPyramid::Level coarse_heights_of(const StoredMap& heights, Boundary boundary, const WindowPlace& place,
                                       int level) {
  assert(level >= 1 && (place.first_row & ((1 << level) - 1)) == 0);
  const Map samples =
      read_occluders(heights, boundary, {place.first_row, place.first_column, place.height, place.width});
  HeightPyramid::Level blocks = coarsen_heights(samples, samples);
  for (int l = 1; l < level; ++l) blocks = coarsen_heights(blocks.mean, blocks.highest);
  return blocks;
}

Map coarse_field_of(Map field, int level) {
  for (int l = 0; l < level; ++l) field = coarsened(field);
  return field;
}

}  // namespace heightlight
