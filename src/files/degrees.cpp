#include "files/degrees.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heightlight {

bool looks_like_degrees(const Georeference& place, int columns, int rows, double relief) {
  constexpr double kCoarsestCell = 0.5;
  if (!place.corner) return false;
  const double x_extent = place.cell.x * columns;
  const double y_extent = place.cell.y * rows;
  const double west = (*place.corner)[0];
  const double south = (*place.corner)[1] - y_extent;
  if (west == 0 && south == 0) return false;
  // Files round their cell size, so that a map of the whole globe may extend a little beyond it.
  const double slack = std::max(place.cell.x, place.cell.y);
  const bool on_globe = west >= -180 - slack && west + x_extent <= 360 + slack && south >= -90 - slack &&
                        south + y_extent <= 90 + slack;
  return on_globe && std::max(place.cell.x, place.cell.y) < kCoarsestCell &&
         relief > std::max(x_extent, y_extent);
}

Spacing degrees_in_metres(const Spacing& degrees, double latitude) {
  const double latitude_rad = latitude * std::numbers::pi / 180;
  // Lengths of a degree on the WGS 84 ellipsoid, as cosine series of the latitude; accurate to a centimetre.
  const double metres_east = 111412.84 * std::cos(latitude_rad) - 93.5 * std::cos(3 * latitude_rad) +
                             0.118 * std::cos(5 * latitude_rad);
  const double metres_north = 111132.92 - 559.82 * std::cos(2 * latitude_rad) +
                              1.175 * std::cos(4 * latitude_rad) - 0.0023 * std::cos(6 * latitude_rad);
  return {degrees.x * metres_east, degrees.y * metres_north};
}

}  // namespace heightlight
