#include "window/read_around.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace heightlight {
namespace {

/// Samples along an axis that follow each other in the map, and where they belong.
struct AxisRun {
  int from = 0;  ///< in the map
  int to = 0;    ///< in the rectangle
  int count = 0;
};

std::vector<AxisRun> axis_runs(int first, int count, int samples, bool tiles) {
  std::vector<AxisRun> runs;
  if (!tiles) {
    const int begin = std::max(first, 0);
    const int end = std::min(first + count, samples);
    if (begin < end) runs.push_back({begin, begin - first, end - begin});
    return runs;
  }
  for (int done = 0; done < count;) {
    const int from = ((first + done) % samples + samples) % samples;
    const int run = std::min(count - done, samples - from);
    runs.push_back({from, done, run});
    done += run;
  }
  return runs;
}

}  // namespace

Map read_around(const StoredMap& stored, Boundary boundary, const MapRect& rect) {
  const bool tiles = boundary == Boundary::tile;
  Map map(rect.columns, rect.rows, std::numeric_limits<float>::quiet_NaN());
  std::vector<float> part;
  for (const AxisRun& rows : axis_runs(rect.first_row, rect.rows, stored.height(), tiles)) {
    for (const AxisRun& columns : axis_runs(rect.first_column, rect.columns, stored.width(), tiles)) {
      part.resize(static_cast<std::size_t>(rows.count) * static_cast<std::size_t>(columns.count));
      stored.read({rows.from, columns.from, rows.count, columns.count}, part.data());
      for (int i = 0; i < rows.count; ++i)
        std::copy_n(part.data() + std::ptrdiff_t{i} * columns.count, columns.count,
                    &map(rows.to + i, columns.to));
    }
  }
  return map;
}

}  // namespace heightlight
