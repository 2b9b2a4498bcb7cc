#pragma once

#include <array>
#include <vector>

#include "visibility/height_pyramid.h"
#include "visibility/walk_table.h"

namespace heightlight {

/// Number of entries behind the end of an array that vector loads may touch.
constexpr int kReadPadding = 16;

/// The part of one level of the heights that the receivers of a tile read. Blocks are named by their row and
/// column of that level in the map. The numbering continues beyond the map's edges.
struct HeightWindow {
  int level = 0;
  int first_row = 0;  ///< row of the block in the window's upper left corner
  int first_column = 0;
  int width = 0;  ///< blocks in a row
  int height = 0;
  std::vector<float> values;  ///< padded by kReadPadding; heights above the tile's reference; kNoHeight where
                              ///< there is nothing

  /// Address of a block that lies in the window; `at` returns its height.
  const float* address(int row, int column) const {
    return values.data() + std::ptrdiff_t{row - first_row} * width + (column - first_column);
  }
  float at(int row, int column) const { return *address(row, column); }
};

/// Squares of receivers that look at far things together, and the lowest and highest of their heights above
/// the tile's reference; both are 0 in squares that hold no receiver.
struct ReceiverGroups {
  int side = 0;    ///< receivers in a row of a group
  int across = 0;  ///< groups in a row of the tile
  std::vector<float> lowest;
  std::vector<float> highest;
};

/// Where a tile of receivers lies in the map.
struct TileFrame {
  static constexpr int kSide = kTileSide;

  int first_row = 0;  ///< a multiple of kWideGroup; whole tiles begin at multiples of kSide
  int first_column = 0;
  int rows = 0;  ///< rows inside the map; the rest of the tile is to be ignored
  int columns = 0;
};

/// The grid of tiles that covers a map: the number of tiles in a row and in a column.
struct TileGrid {
  int across = 0;
  int down = 0;
  int width = 0;
  int height = 0;

  TileGrid(int map_width, int map_height)
      : across((map_width + TileFrame::kSide - 1) / TileFrame::kSide),
        down((map_height + TileFrame::kSide - 1) / TileFrame::kSide),
        width(map_width),
        height(map_height) {}

  std::int64_t count() const { return std::int64_t{across} * down; }
  /// The i-th tile, row by row.
  TileFrame frame(std::int64_t i) const;
};

/// Receivers of kSide × kSide texels, laid out for vectors: row-major, kSide per row.
struct ReceiverTile : TileFrame {
  static constexpr int kTexels = kSide * kSide;

  int map_row = 0;  ///< of its corner, in the whole map: first_row except in windows of a larger map
  int map_column = 0;
  alignas(64) std::array<float, kTexels> height;  ///< above the tile's reference; −kNoHeight where missing,
                                                  ///< so that a missing receiver sees nothing
  alignas(64) std::array<float, kTexels> slope_x;  ///< of the tangent plane along x, per world unit
  alignas(64) std::array<float, kTexels> slope_y;
  alignas(64) std::array<float, kTexels> normal_z;
  alignas(64) std::array<float, kTexels> level_x;  ///< slope along x of what is level there (level_gradient)
  alignas(64) std::array<float, kTexels> level_y;
  std::array<bool, kTexels> present;

  void load_receivers(const Surface& surface, float reference, const TileFrame& frame);
};

/// Calls visit(index in the tile, row, column) for every receiver that is present; row and column are the
/// map's.
template <class Visit>
void for_present(const ReceiverTile& tile, Visit&& visit) {
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; ++j) {
      const auto at = static_cast<std::size_t>(i * ReceiverTile::kSide + j);
      if (tile.present[at]) visit(at, tile.first_row + i, tile.first_column + j);
    }
  }
}

/// Receivers with the heights around them, copied from the map. Borders, holes and wrapping are resolved
/// while copying, so that walks need not know of them.
struct WalkTile : ReceiverTile {
  static constexpr int kGroup = 4;
  static constexpr int kWideGroup = 8;
  static constexpr float kLift = 0.2F;

  ReceiverGroups groups;       ///< groups of kGroup receivers a side
  ReceiverGroups wide_groups;  ///< groups of kWideGroup receivers a side

  std::vector<HeightWindow> windows;  ///< [0]: the samples themselves; [r]: the blocks of ring r
  /// As windows[0], but each sample is raised by kLift of what the highest of it and its eight neighbours has
  /// above it. Samples at the window's own edge are not raised.
  HeightWindow lifted;

  /// Copies everything that walks with these options and `rings` rings may read. Reuses its memory.
  void load(const Surface& surface, const HeightPyramid& pyramid, const WalkOptions& options, int rings,
            const TileFrame& frame);
};

}  // namespace heightlight
