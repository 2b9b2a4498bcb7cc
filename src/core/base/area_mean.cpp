#include "base/area_mean.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/parallel.h"

namespace heightlight {
namespace {

/// The samples [begin, end), of `from` in all, that make up the i-th of `to` parts.
struct Part {
  int begin = 0;
  int end = 0;

  Part(int i, int from, int to)
      : begin(static_cast<int>(std::int64_t{i} * from / to)),
        end(std::max(begin + 1, static_cast<int>(std::int64_t{i + 1} * from / to))) {}
};

float mean_of(const Map& map, const Part& rows, const Part& columns) {
  double sum = 0;
  int count = 0;
  for (int row = rows.begin; row < rows.end; ++row) {
    for (int column = columns.begin; column < columns.end; ++column) {
      const float value = map(row, column);
      if (std::isnan(value)) continue;
      sum += static_cast<double>(value);
      ++count;
    }
  }
  return count > 0 ? static_cast<float>(sum / count) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Map area_mean(const Map& map, int width, int height) {
  assert(map.width >= 1 && map.height >= 1 && width >= 1 && height >= 1);
  Map mean(width, height);
  parallel_for(height, [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    const Part rows(row, map.height, height);
    for (int column = 0; column < width; ++column)
      mean(row, column) = mean_of(map, rows, Part(column, map.width, width));
  });
  return mean;
}

}  // namespace heightlight
