#include "surface/maximum_pyramid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

int ceil_shift(int value, int bits) {
  return static_cast<int>((std::int64_t{value} + (1LL << bits) - 1) >> bits);
}

int level_count(int columns, int rows) {
  return std::bit_width(static_cast<unsigned>(std::max(columns, rows) - 1)) + 1;
}

float cell_maximum(const Surface& surface, int row, int column) {
  const Image<float>& h = surface.map.height;
  const int below = row + 1 < h.height ? row + 1 : 0;
  const int right = column + 1 < h.width ? column + 1 : 0;
  // fmax passes over NaN, the missing samples.
  const float upper = std::fmax(h(row, column), h(row, right));
  const float highest = std::fmax(upper, std::fmax(h(below, column), h(below, right)));
  return std::isnan(highest) ? kNothing : highest;
}

/// Levels from `first` on, without bounds.
MaximumPyramid lay_out(int first, int columns, int rows) {
  MaximumPyramid pyramid;
  pyramid.levels = std::max(level_count(columns, rows), first + 1);
  pyramid.stride_bits = pyramid.levels - 1;
  std::int32_t offset = 0;
  for (int level = first; level < pyramid.levels; ++level) {
    pyramid.offset[static_cast<std::size_t>(level)] = offset;
    offset += ceil_shift(rows, level) << (pyramid.stride_bits - level);
  }
  pyramid.highest.assign(static_cast<std::size_t>(offset), kNothing);
  return pyramid;
}

/// Each block covers up to 2 × 2 blocks of the level below; the odd ones out at the borders have fewer.
void fill_above(int first, int columns, int rows, MaximumPyramid& pyramid) {
  for (int level = first + 1; level < pyramid.levels; ++level) {
    const int half = 1 << (level - 1);
    for (int i = 0; i < rows; i += 2 * half) {
      for (int j = 0; j < columns; j += 2 * half) {
        float highest = kNothing;
        for (int di = 0; di < 2; ++di) {
          for (int dj = 0; dj < 2; ++dj) {
            if (i + di * half >= rows || j + dj * half >= columns) continue;
            const std::int32_t child = pyramid.index(level - 1, i + di * half, j + dj * half);
            highest = std::max(highest, pyramid.highest[static_cast<std::size_t>(child)]);
          }
        }
        pyramid.highest[static_cast<std::size_t>(pyramid.index(level, i, j))] = highest;
      }
    }
  }
}

}  // namespace

std::uint64_t maximum_pyramid_bytes(int cell_columns, int cell_rows) {
  const int stride_bits = level_count(cell_columns, cell_rows) - 1;
  std::uint64_t entries = 0;
  for (int level = 0; level <= stride_bits; ++level) {
    entries += static_cast<std::uint64_t>(ceil_shift(cell_rows, level)) << (stride_bits - level);
  }
  return entries * sizeof(float);
}

MaximumPyramid build_maximum_pyramid(const Surface& surface) {
  const int columns = surface.cell_columns();
  const int rows = surface.cell_rows();
  const std::uint64_t bytes = maximum_pyramid_bytes(columns, rows);
  if (bytes / sizeof(float) > static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max())) {
    throw Error("a map of " + std::to_string(columns) + " × " + std::to_string(rows) +
                " cells is too large for rays");
  }
  MaximumPyramid pyramid = lay_out(0, columns, rows);
  parallel_for(rows, [&](std::int64_t row) {
    for (int column = 0; column < columns; ++column) {
      const int i = static_cast<int>(row);
      pyramid.highest[static_cast<std::size_t>(pyramid.index(0, i, column))] =
          cell_maximum(surface, i, column);
    }
  });
  fill_above(0, columns, rows, pyramid);
  return pyramid;
}

MaximumPyramid complete_maximum_pyramid(int first, const Map& blocks, int cell_columns, int cell_rows) {
  MaximumPyramid pyramid = lay_out(first, cell_columns, cell_rows);
  const int side = 1 << first;
  for (int i = 0; i < cell_rows; i += side) {
    for (int j = 0; j < cell_columns; j += side)
      pyramid.highest[static_cast<std::size_t>(pyramid.index(first, i, j))] = blocks(i / side, j / side);
  }
  fill_above(first, cell_columns, cell_rows, pyramid);
  return pyramid;
}

}  // namespace heightlight
