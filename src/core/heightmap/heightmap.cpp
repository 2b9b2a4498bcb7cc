#include "heightlight/heightmap.h"

#include <algorithm>
#include <cmath>

namespace heightlight {

const char* to_string(Boundary boundary) { return boundary == Boundary::tile ? "tile" : "open"; }

double relief(const Heightmap& map) {
  float lowest = INFINITY;
  float highest = -INFINITY;
  for (const float height : map.height.values) {
    if (std::isnan(height)) continue;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return lowest <= highest ? static_cast<double>(highest) - static_cast<double>(lowest) : 0;
}

std::size_t count_missing(const Heightmap& map) {
  return static_cast<std::size_t>(std::count_if(map.height.values.begin(), map.height.values.end(),
                                                [](float height) { return std::isnan(height); }));
}

}  // namespace heightlight
