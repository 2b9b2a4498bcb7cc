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
  MaximumPyramid pyramid;
  pyramid.levels = level_count(columns, rows);
  pyramid.stride_bits = pyramid.levels - 1;
  pyramid.highest.assign(bytes / sizeof(float), kNothing);
  std::int32_t offset = 0;
  for (int level = 0; level < pyramid.levels; ++level) {
    pyramid.offset[static_cast<std::size_t>(level)] = offset;
    offset += ceil_shift(rows, level) << (pyramid.stride_bits - level);
  }
  parallel_for(rows, [&](std::int64_t row) {
    for (int column = 0; column < columns; ++column) {
      const int i = static_cast<int>(row);
      pyramid.highest[static_cast<std::size_t>(pyramid.index(0, i, column))] =
          cell_maximum(surface, i, column);
    }
  });
  for (int level = 1; level < pyramid.levels; ++level) {
    // Each block covers up to 2 × 2 blocks of the level below; the odd ones out at the borders have fewer.
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
  return pyramid;
}

}  // namespace heightlight
