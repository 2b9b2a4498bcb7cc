#include "window/window_surface.h"

#include <algorithm>
#include <cassert>

#include "surface/blocks.h"
#include "visibility/horizon_scene.h"
#include "visibility/surroundings.h"
#include "visibility/walk_table.h"
#include "window/read_around.h"

namespace heightlight {
namespace {

MapRect rect_of(const WindowBlocks& blocks) {
  return {blocks.first_row, blocks.first_column, blocks.height, blocks.width};
}

/// Its parts, `levels` levels below.
MapRect refined(const MapRect& rect, int levels) {
  const int scale = 1 << levels;
  return {rect.first_row * scale, rect.first_column * scale, rect.rows * scale, rect.columns * scale};
}

/// The part of a map that has the place `from` which is at `rect`.
Map part_of(const Map& map, const MapRect& from, const MapRect& rect) {
  const int down = rect.first_row - from.first_row;
  const int right = rect.first_column - from.first_column;
  assert(down >= 0 && right >= 0 && down + rect.rows <= map.height && right + rect.columns <= map.width);
  Map part(rect.columns, rect.rows);
  for (int row = 0; row < rect.rows; ++row) std::copy_n(&map(row + down, right), rect.columns, &part(row, 0));
  return part;
}

/// Samples of the levels below the coarse ones that any of them needs.
MapRect samples_of_fine_levels(const WindowPlace& place, int margin, int first_coarse) {
  const int last = first_coarse - 1;
  return refined(rect_of(window_blocks(place, last, margin)), last);
}

void add_fine_levels(const MapParts& map, const WindowPlace& place, int levels, Surroundings& around) {
  const int fine = std::min(levels, map.coarse.first);
  MapRect at = samples_of_fine_levels(place, around.margin, map.coarse.first);
  Map mean = read_occluders(map.heights, map.boundary, at);
  Map highest;
  for (int l = 0; l < fine; ++l) {
    if (l > 0) {
      HeightPyramid::Level next = coarsen_heights(mean, l == 1 ? mean : highest);
      mean = std::move(next.mean);
      highest = std::move(next.highest);
      at = {at.first_row / 2, at.first_column / 2, at.rows / 2, at.columns / 2};
    }
    const WindowBlocks blocks = window_blocks(place, l, around.margin);
    Surroundings::Level& level = around.levels.emplace_back();
    level.blocks = blocks;
    level.mean = part_of(mean, at, rect_of(blocks));
    if (l > 0) level.highest = part_of(highest, at, rect_of(blocks));
  }
}

/// Blocks of a level by their index along both axes; −1 where nothing is.
struct BlockSources {
  std::vector<int> rows;
  std::vector<int> columns;

  BlockSources(const WindowBlocks& blocks, int level, const WindowPlace& place, bool tiles)
      : rows(block_sources(blocks.first_row, blocks.height, level, place.map_height, tiles)),
        columns(block_sources(blocks.first_column, blocks.width, level, place.map_width, tiles)) {}
};

void add_coarse_levels(const MapParts& map, const WindowPlace& place, int levels, Surroundings& around) {
  for (int l = map.coarse.first; l < levels; ++l) {
    const WindowBlocks blocks = window_blocks(place, l, around.margin);
    const BlockSources sources(blocks, l, place, map.boundary == Boundary::tile);
    const auto last = static_cast<int>(map.coarse.levels.size()) - 1;
    const HeightPyramid::Level& whole =
        map.coarse.levels[static_cast<std::size_t>(std::min(l - map.coarse.first, last))];
    Surroundings::Level level{blocks, Map(blocks.width, blocks.height, kNoHeight),
                              Map(blocks.width, blocks.height, kNoHeight)};
    for (int i = 0; i < blocks.height; ++i) {
      for (int j = 0; j < blocks.width; ++j) {
        const int row = sources.rows[static_cast<std::size_t>(i)];
        const int column = sources.columns[static_cast<std::size_t>(j)];
        if (row < 0 || column < 0) continue;
        level.mean(i, j) = whole.mean(row, column);
        level.highest(i, j) = whole.highest(row, column);
      }
    }
    around.levels.push_back(std::move(level));
  }
}

/// Samples and normals of the window itself.
Surface bare_surface(const MapParts& map, const WindowPlace& place) {
  const MapRect with_border{place.first_row - 1, place.first_column - 1, place.height + 2, place.width + 2};
  const MapRect inside{place.first_row, place.first_column, place.height, place.width};
  const Surface wider = build_surface({.height = read_around(map.heights, map.boundary, with_border),
                                       .spacing = map.spacing,
                                       .boundary = Boundary::open});
  Surface surface;
  surface.map = {.height = part_of(wider.map.height, with_border, inside),
                 .base = map.base,
                 .spacing = map.spacing,
                 .boundary = map.boundary,
                 .curvature = map.curvature,
                 .curved_about_row = 0.5 * (place.map_height - 1) - place.first_row,
                 .curved_about_column = 0.5 * (place.map_width - 1) - place.first_column};
  surface.normal = Image<Vector3>(place.width, place.height);
  for (int row = 0; row < place.height; ++row)
    std::copy_n(&wider.normal(row + 1, 1), place.width, &surface.normal(row, 0));
  surface.lowest = map.lowest;
  surface.highest = map.highest;
  return surface;
}

/// With up to a row and a column more, so that two blocks each along an axis make one of the level above.
MapRect from_even_blocks(const MapRect& rect) {
  const int down = rect.first_row & 1;
  const int right = rect.first_column & 1;
  return {rect.first_row - down, rect.first_column - right, rect.rows + down, rect.columns + right};
}

/// A field's fine levels, of which those inside an open map's edges exist.
MapRect inside_map(const MapRect& rect, int rows, int columns, bool tiles) {
  if (tiles) return rect;
  const int top = std::max(rect.first_row, 0);
  const int left = std::max(rect.first_column, 0);
  return {top, left, std::min(rect.first_row + rect.rows, rows) - top,
          std::min(rect.first_column + rect.columns, columns) - left};
}

/// The part of a level at `rect`, which lies at `at`; beyond it the outermost value stands.
Map stretched_part(const Map& level, const MapRect& at, const MapRect& rect) {
  Map part(rect.columns, rect.rows);
  for (int i = 0; i < rect.rows; ++i) {
    const int row = std::clamp(rect.first_row + i - at.first_row, 0, at.rows - 1);
    for (int j = 0; j < rect.columns; ++j)
      part(i, j) = level(row, std::clamp(rect.first_column + j - at.first_column, 0, at.columns - 1));
  }
  return part;
}

MapRect level_rect(const FieldPyramid::Level& level) {
  return {level.first_row - level.margin, level.first_column - level.margin, level.height + 2 * level.margin,
          level.width + 2 * level.margin};
}

/// Of a coarse level, by blocks of the map; beyond the edges of an open map the outermost stand.
Map coarse_part(const CoarseField& coarse, int l, const FieldPyramid::Level& level, const Surface& window) {
  const WindowPlace place = place_in_map(window);
  const MapRect rect = level_rect(level);
  const BlockSources sources({rect.first_row, rect.first_column, rect.columns, rect.rows}, l, place,
                             window.tiles());
  const auto last = static_cast<int>(coarse.levels.size()) - 1;
  const Map& whole = coarse.levels[static_cast<std::size_t>(std::min(l - coarse.first, last))];
  const auto at = [](int source, int wanted, int count) {
    return source >= 0 ? source : wanted < 0 ? 0 : count - 1;
  };
  Map part(rect.columns, rect.rows);
  for (int i = 0; i < rect.rows; ++i) {
    const int row = at(sources.rows[static_cast<std::size_t>(i)], rect.first_row + i, whole.height);
    for (int j = 0; j < rect.columns; ++j)
      part(i, j) =
          whole(row, at(sources.columns[static_cast<std::size_t>(j)], rect.first_column + j, whole.width));
  }
  return part;
}

/// The finest coarse level around blocks of the level below it, at half their rows and columns.
Map parents_of(const CoarseField& coarse, const MapRect& at, const Surface& window) {
  const WindowPlace place = place_in_map(window);
  const WindowBlocks blocks{at.first_row / 2, at.first_column / 2, half_blocks(at.columns),
                            half_blocks(at.rows)};
  const BlockSources sources(blocks, coarse.first, place, window.tiles());
  Map parents(blocks.width, blocks.height);
  for (int i = 0; i < blocks.height; ++i) {
    for (int j = 0; j < blocks.width; ++j)
      parents(i, j) = coarse.levels[0](sources.rows[static_cast<std::size_t>(i)],
                                       sources.columns[static_cast<std::size_t>(j)]);
  }
  return parents;
}

}  // namespace

WindowView window_view(const MapParts& map, const WalkOptions& options) {
  Surface whole;  // of which rings ask no more than these
  whole.map.spacing = map.spacing;
  whole.map.boundary = map.boundary;
  whole.lowest = map.lowest;
  whole.highest = map.highest;
  whole.map.height.width = map.heights.width();
  whole.map.height.height = map.heights.height();
  return {.margin = walk_margin(options), .levels = ring_count(whole, options) + 1};
}

Surface window_surface(const MapParts& map, const WindowPlace& place, const WindowView& view) {
  assert(place.first_row % kTileSide == 0 && place.first_column % kTileSide == 0);
  Surface surface = bare_surface(map, place);
  auto around = std::make_shared<Surroundings>();
  around->place = place;
  around->margin = view.margin;
  add_fine_levels(map, place, view.levels, *around);
  add_coarse_levels(map, place, view.levels, *around);
  surface.around = std::move(around);
  return surface;
}

void fill_window_field(const Surface& window, const StoredMap& field, const CoarseField& coarse,
                       FieldPyramid& layout) {
  const WindowPlace place = place_in_map(window);
  const bool tiles = window.tiles();
  const int margin = layout.level(0).margin;
  const int levels = layout.levels();
  std::vector<Map> fine;
  std::vector<MapRect> at;
  const MapRect last = from_even_blocks(rect_of(window_blocks(place, coarse.first - 1, margin)));
  for (int l = 0; l < coarse.first; ++l) {
    const int across = ((place.map_width - 1) >> l) + 1;
    const int down = ((place.map_height - 1) >> l) + 1;
    at.push_back(inside_map(refined(last, coarse.first - 1 - l), down, across, tiles));
    if (l == 0) {
      fine.push_back(read_around(field, window.map.boundary, at[0]));
    } else {
      fine.emplace_back(at.back().columns, at.back().rows);
      coarsen_field(view_of(fine[fine.size() - 2]), view_of(fine.back()));
    }
  }
  Map parents = parents_of(coarse, at.back(), window);
  for (std::size_t l = fine.size(); l-- > 0;) {
    const FieldView above = l + 1 < fine.size() ? view_of(fine[l + 1]) : view_of(parents);
    fill_field_holes(view_of(fine[l]), &above);
  }
  for (int l = 0; l < levels; ++l) {
    const FieldPyramid::Level& level = layout.level(l);
    layout.take_level(l, l < coarse.first ? stretched_part(fine[static_cast<std::size_t>(l)],
                                                           at[static_cast<std::size_t>(l)], level_rect(level))
                                          : coarse_part(coarse, l, level, window));
  }
}

}  // namespace heightlight
