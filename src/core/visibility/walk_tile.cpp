#include "visibility/walk_tile.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "surface/blocks.h"
#include "visibility/surroundings.h"

namespace heightlight {
namespace {

ReceiverGroups span_groups(const WalkTile& tile, int side) {
  ReceiverGroups groups;
  groups.side = side;
  groups.across = WalkTile::kSide / side;
  for (int row = 0; row < WalkTile::kSide; row += side) {
    for (int column = 0; column < WalkTile::kSide; column += side) {
      float lowest = -kNoHeight;
      float highest = kNoHeight;
      for (int i = row; i < row + side; ++i) {
        for (int j = column; j < column + side; ++j) {
          const auto at = static_cast<std::size_t>(i * WalkTile::kSide + j);
          if (!tile.present[at]) continue;
          lowest = std::min(lowest, tile.height[at]);
          highest = std::max(highest, tile.height[at]);
        }
      }
      groups.lowest.push_back(lowest <= highest ? lowest : 0);
      groups.highest.push_back(lowest <= highest ? highest : 0);
    }
  }
  return groups;
}

/// Places a window so that it reaches `margin` blocks beyond the tile on all sides.
void place(HeightWindow& window, int level, int margin, int row, int column) {
  const int across = (WalkTile::kSide >> level) + 2 + 2 * margin;
  window.level = level;
  window.first_row = (row >> level) - margin;
  window.first_column = (column >> level) - margin;
  window.width = across;
  window.height = across;
  window.values.resize(static_cast<std::size_t>(across) * static_cast<std::size_t>(across) + kReadPadding);
}

/// Consecutive columns of a window that are also consecutive in the map, or where nothing is (map_column <
/// 0).
struct ColumnRun {
  int map_column;
  int count;
};

std::vector<ColumnRun> column_runs(const std::vector<int>& columns) {
  std::vector<ColumnRun> runs;
  for (const int column : columns) {
    const bool goes_on =
        !runs.empty() &&
        (column < 0 ? runs.back().map_column < 0
                    : runs.back().map_column >= 0 && column == runs.back().map_column + runs.back().count);
    if (goes_on) {
      ++runs.back().count;
    } else {
      runs.push_back({column, 1});
    }
  }
  return runs;
}

void copy_heights(const float* heights, int count, float reference, float* out) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const float height = heights[i] - reference;
    out[i] = std::isnan(height) ? kNoHeight : height;
  }
}

/// How the heights of blocks are made: the share of the peak, and the reference that is subtracted.
struct Blend {
  float peak_share;
  float reference;
};

void blend_heights(const float* mean, const float* highest, int count, const Blend& blend, float* out) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const float height = mean[i] + blend.peak_share * (highest[i] - mean[i]) - blend.reference;
    out[i] = mean[i] == kNoHeight ? kNoHeight : height;
  }
}

void fill_nearest(HeightWindow& window, const Image<float>& heights, bool tiles, float reference) {
  const std::vector<int> rows = block_sources(window.first_row, window.height, 0, heights.height, tiles);
  const std::vector<ColumnRun> runs =
      column_runs(block_sources(window.first_column, window.width, 0, heights.width, tiles));
  float* out = window.values.data();
  for (const int row : rows) {
    for (const ColumnRun& run : runs) {
      if (row < 0 || run.map_column < 0) {
        std::fill_n(out, run.count, kNoHeight);
      } else {
        copy_heights(&heights(row, run.map_column), run.count, reference, out);
      }
      out += run.count;
    }
  }
}

/// Fills a window from the surroundings of a window of the map, with samples or with blocks. Beyond the
/// margin of the surroundings it is left empty: that part is seen only from beyond the map's window, where
/// the last tiles of a map may reach.
void fill_from(const Surroundings& around, const Blend& blend, HeightWindow& window) {
  const Surroundings::Level& level = around.levels[static_cast<std::size_t>(window.level)];
  const int top = window.first_row - level.blocks.first_row;
  const int left = window.first_column - level.blocks.first_column;
  assert(top >= 0 && left >= 0);
  const int rows = std::min(window.height, level.blocks.height - top);
  const int columns = std::min(window.width, level.blocks.width - left);
  std::fill(window.values.begin(), window.values.end(), kNoHeight);
  for (int i = 0; i < rows; ++i) {
    float* out = window.values.data() + std::ptrdiff_t{i} * window.width;
    const float* mean = &level.mean(top + i, left);
    if (window.level == 0) {
      copy_heights(mean, columns, blend.reference, out);
    } else {
      blend_heights(mean, &level.highest(top + i, left), columns, blend, out);
    }
  }
}

void fill_blocks(HeightWindow& window, const HeightPyramid& pyramid, const Surface& surface, float peak_share,
                 float reference) {
  if (pyramid.levels.empty()) {
    std::fill(window.values.begin(), window.values.end(), surface.map.height.values[0] - reference);
    return;
  }
  const int level = std::min(window.level, static_cast<int>(pyramid.levels.size()));
  const HeightPyramid::Level& blocks = pyramid.levels[static_cast<std::size_t>(level) - 1];
  const std::vector<int> rows =
      block_sources(window.first_row, window.height, window.level, surface.height(), surface.tiles());
  const std::vector<ColumnRun> runs = column_runs(
      block_sources(window.first_column, window.width, window.level, surface.width(), surface.tiles()));
  float* out = window.values.data();
  for (const int row : rows) {
    for (const ColumnRun& run : runs) {
      if (row < 0 || run.map_column < 0) {
        std::fill_n(out, run.count, kNoHeight);
      } else {
        blend_heights(&blocks.mean(row, run.map_column), &blocks.highest(row, run.map_column), run.count,
                      {peak_share, reference}, out);
      }
      out += run.count;
    }
  }
}

void lift(const HeightWindow& samples, HeightWindow& lifted) {
  lifted = samples;
  const int width = samples.width;
  std::vector<float> highest(static_cast<std::size_t>(width));  // of three samples in a column
  for (int row = 1; row + 1 < samples.height; ++row) {
    const float* here = samples.values.data() + std::ptrdiff_t{row} * width;
    float* out = lifted.values.data() + std::ptrdiff_t{row} * width;
    for (int column = 0; column < width; ++column) {
      highest[static_cast<std::size_t>(column)] =
          std::max(here[column], std::max(here[column - width], here[column + width]));
    }
    const float* peaks = highest.data();
    for (int column = 1; column + 1 < width; ++column) {
      const float peak = std::max(peaks[column], std::max(peaks[column - 1], peaks[column + 1]));
      out[column] = here[column] + WalkTile::kLift * (peak - here[column]);
    }
  }
}

}  // namespace

TileFrame TileGrid::frame(std::int64_t i) const {
  TileFrame frame;
  frame.first_row = static_cast<int>(i / across) * TileFrame::kSide;
  frame.first_column = static_cast<int>(i % across) * TileFrame::kSide;
  frame.rows = std::min(TileFrame::kSide, height - frame.first_row);
  frame.columns = std::min(TileFrame::kSide, width - frame.first_column);
  return frame;
}

void ReceiverTile::load_receivers(const Surface& surface, float reference, const TileFrame& frame) {
  static_cast<TileFrame&>(*this) = frame;
  const WindowPlace place = place_in_map(surface);
  map_row = frame.first_row + place.first_row;
  map_column = frame.first_column + place.first_column;
  const Image<float>& map = surface.map.height;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; j < kSide; ++j) {
      const auto at = static_cast<std::size_t>(i * kSide + j);
      const bool inside = i < rows && j < columns;
      present[at] = inside && !std::isnan(map(first_row + i, first_column + j));
      height[at] = present[at] ? map(first_row + i, first_column + j) - reference : -kNoHeight;
      const Vector3 normal = present[at] ? surface.normal(first_row + i, first_column + j) : Vector3{0, 0, 1};
      const float falls = -1 / normal.z;
      slope_x[at] = falls * normal.x;
      slope_y[at] = falls * normal.y;
      normal_z[at] = normal.z;
      const Gradient level = level_gradient(surface.map, first_row + i, first_column + j);
      level_x[at] = static_cast<float>(level.x);
      level_y[at] = static_cast<float>(level.y);
    }
  }
}

void WalkTile::load(const Surface& surface, const HeightPyramid& pyramid, const WalkOptions& options,
                    int rings, const TileFrame& frame) {
  const int row = frame.first_row;
  const int column = frame.first_column;
  const Image<float>& map = surface.map.height;
  float reference = 0;  // a height of the tile's own: level ground stays level, and digits go to differences
  for (int i = 0; i < frame.rows * frame.columns; ++i) {
    const float value = map(row + i / frame.columns, column + i % frame.columns);
    if (std::isnan(value)) continue;
    reference = value;
    break;
  }
  load_receivers(surface, reference, frame);
  groups = span_groups(*this, kGroup);
  wide_groups = span_groups(*this, kWideGroup);
  windows.resize(static_cast<std::size_t>(rings) + 1);
  const Surroundings* around = surface.around.get();
  place(windows[0], 0, near_margin(options), map_row, map_column);
  if (around) {
    fill_from(*around, {options.peak_share, reference}, windows[0]);
  } else {
    fill_nearest(windows[0], pyramid.level_0(surface), surface.tiles(), reference);
  }
  lift(windows[0], lifted);
  for (int ring = 1; ring <= rings; ++ring) {
    HeightWindow& window = windows[static_cast<std::size_t>(ring)];
    place(window, ring_level(ring), 4 * options.samples_per_octave + 1, map_row, map_column);
    if (around) {
      fill_from(*around, {options.peak_share, reference}, window);
    } else {
      fill_blocks(window, pyramid, surface, options.peak_share, reference);
    }
  }
}

}  // namespace heightlight
