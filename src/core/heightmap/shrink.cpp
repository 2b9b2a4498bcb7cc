#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "heightlight/error.h"
#include "heightlight/heightmap.h"

namespace heightlight {
namespace {

/// Mean of the samples present in a square; NaN where none is.
float mean_of_square(const Image<float>& heights, int first_row, int first_column, int side) {
  double sum = 0;
  int present = 0;
  for (int row = first_row; row < first_row + side; ++row) {
    for (int column = first_column; column < first_column + side; ++column) {
      const float height = heights(row, column);
      if (std::isnan(height)) continue;
      sum += double{height};
      ++present;
    }
  }
  return present > 0 ? static_cast<float>(sum / present) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Heightmap shrink(const Heightmap& map, int factor) {
  const int width = map.height.width;
  const int height = map.height.height;
  if (factor < 1 || width % factor != 0 || height % factor != 0) {
    throw UsageError(
        "shrink", std::to_string(factor),
        "does not divide " + std::to_string(width) + " × " + std::to_string(height) + " samples");
  }
  Heightmap shrunk = map;
  shrunk.spacing = {map.spacing.x * factor, map.spacing.y * factor};
  shrunk.height = Image<float>(width / factor, height / factor);
  const auto in_squares = [&](double sample) { return (sample + 0.5) / factor - 0.5; };
  shrunk.curved_about_row = in_squares(map.curved_about_row);
  shrunk.curved_about_column = in_squares(map.curved_about_column);
  float lowest = std::numeric_limits<float>::infinity();
  for (int row = 0; row < shrunk.height.height; ++row) {
    for (int column = 0; column < shrunk.height.width; ++column) {
      const float mean = mean_of_square(map.height, row * factor, column * factor, factor);
      shrunk.height(row, column) = mean;
      if (mean < lowest) lowest = mean;
    }
  }
  if (std::isinf(lowest)) return shrunk;  // nothing but missing samples
  for (float& above : shrunk.height.values) above -= lowest;
  shrunk.base += double{lowest};
  return shrunk;
}

}  // namespace heightlight
