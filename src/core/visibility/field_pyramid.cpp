#include "visibility/field_pyramid.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "surface/blocks.h"
#include "visibility/field_levels.h"
#include "visibility/height_pyramid.h"
#include "visibility/surroundings.h"

namespace heightlight {
namespace {

/// The levels without their values.
std::vector<FieldPyramid::Level> lay_out(const WindowPlace& place, int levels, int margin) {
  std::vector<FieldPyramid::Level> layout;
  for (int l = 0; l <= levels; ++l) {
    const WindowBlocks blocks = window_blocks(place, l, 0);
    layout.push_back({.first_row = blocks.first_row,
                      .first_column = blocks.first_column,
                      .width = blocks.width,
                      .height = blocks.height,
                      .margin = margin,
                      .values = {}});
  }
  return layout;
}

std::size_t value_count(const FieldPyramid::Level& level) {
  return static_cast<std::size_t>(level.stride()) * static_cast<std::size_t>(level.height + 2 * level.margin);
}

}  // namespace

FieldPyramid::FieldPyramid(const Surface& surface, int levels, int margin)
    : surface_(surface), levels_(lay_out(place_in_map(surface), levels, margin)) {
  for (Level& level : levels_) level.values.assign(value_count(level), 0);
}

void FieldPyramid::fill(const Map& values) {
  Level& finest = levels_[0];
  assert(!surface_.around && values.width == finest.width && values.height == finest.height);
  parallel_for(finest.height, [&](std::int64_t row) {
    std::copy_n(values.values.data() + row * finest.width, finest.width,
                finest.origin() + row * finest.stride());
  });
  for (std::size_t l = 1; l < levels_.size(); ++l) coarsen_field(view(l - 1), view(l));
  for (std::size_t l = levels_.size(); l-- > 0;) {
    const bool is_last = l + 1 == levels_.size();
    const FieldView coarse = is_last ? FieldView{} : view(l + 1);
    fill_field_holes(view(l), is_last ? nullptr : &coarse);
    fill_margins(l, nullptr);
  }
}

void FieldPyramid::fill_heights(int l, const Map& heights) {
  Level& level = levels_[static_cast<std::size_t>(l)];
  assert(!surface_.around && heights.width == level.width && heights.height == level.height);
  parallel_for(level.height, [&](std::int64_t row) {
    const float* from = heights.values.data() + row * level.width;
    std::transform(from, from + level.width, level.origin() + row * level.stride(),
                   [](float height) { return std::isnan(height) ? kNoHeight : height; });
  });
  fill_margins(static_cast<std::size_t>(l), &kNoHeight);
}

FieldView FieldPyramid::view(std::size_t l) {
  Level& level = levels_[l];
  return {level.origin(), level.stride(), level.width, level.height};
}

void FieldPyramid::take_level(int l, Map values) {
  Level& level = levels_[static_cast<std::size_t>(l)];
  assert(values.size() == value_count(level) && values.width == level.stride());
  level.values = std::move(values.values);
}

/// `outside`: the value beyond the edges of a map that does not tile; null: the outermost values are
/// repeated.
void FieldPyramid::fill_margins(std::size_t l, const float* outside) {
  Level& level = levels_[l];
  const int margin = level.margin;
  const auto along = [&](int blocks, int samples) {
    std::vector<int> sources =
        block_sources(-margin, blocks + 2 * margin, static_cast<int>(l), samples, surface_.tiles());
    if (outside) return sources;
    for (std::size_t i = 0; i < sources.size(); ++i) {
      if (sources[i] < 0) sources[i] = static_cast<int>(i) < margin ? 0 : blocks - 1;
    }
    return sources;
  };
  const std::vector<int> columns = along(level.width, surface_.width());
  const std::vector<int> rows = along(level.height, surface_.height());
  parallel_for(level.height, [&](std::int64_t row) {
    float* line = level.origin() + row * level.stride();
    const auto source = [&](int column) {
      const int from = columns[static_cast<std::size_t>(margin + column)];
      return from < 0 ? *outside : line[from];
    };
    for (int i = 0; i < margin; ++i) {
      line[i - margin] = source(i - margin);
      line[level.width + i] = source(level.width + i);
    }
  });
  float* top = level.values.data();
  for (int i = 0; i < level.height + 2 * margin; ++i) {
    if (i >= margin && i < margin + level.height) continue;
    const int from = rows[static_cast<std::size_t>(i)];
    if (from < 0) {
      std::fill_n(top + i * level.stride(), level.stride(), *outside);
    } else {
      std::copy_n(top + (margin + from) * level.stride(), level.stride(), top + i * level.stride());
    }
  }
}

int levels_to_one(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::max(width, height)) - 1);
}

std::uint64_t field_pyramid_bytes(int width, int height, int levels, int margin) {
  std::uint64_t bytes = 0;
  const WindowPlace whole{.map_width = width, .map_height = height, .width = width, .height = height};
  for (const FieldPyramid::Level& level : lay_out(whole, levels, margin))
    bytes += value_count(level) * sizeof(float);
  return bytes;
}

}  // namespace heightlight
