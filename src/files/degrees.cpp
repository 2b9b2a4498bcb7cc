#include "files/degrees.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heightlight {

bool is_in_degrees(const EsriHeader& header, double relief) {
  constexpr double kCoarsestCell = 0.5;
  if (!header.west || !header.south || (*header.west == 0 && *header.south == 0)) return false;
  const double x_extent = header.cell_x * header.columns;
  const double y_extent = header.cell_y * header.rows;
  // Files round their cell size, so that a map of the whole globe may end a little beyond it.
  const double slack = std::max(header.cell_x, header.cell_y);
  const bool on_globe = *header.west >= -180 - slack && *header.west + x_extent <= 360 + slack &&
                        *header.south >= -90 - slack && *header.south + y_extent <= 90 + slack;
  return on_globe && std::max(header.cell_x, header.cell_y) < kCoarsestCell &&
         relief > std::max(x_extent, y_extent);
}

Spacing degrees_in_metres(const Spacing& degrees, double latitude) {
  const double latitude_rad = latitude * std::numbers::pi / 180;
  // Lengths of a degree on the WGS 84 ellipsoid as cosine series of the latitude; good to a centimetre.
  const double metres_east = 111412.84 * std::cos(latitude_rad) - 93.5 * std::cos(3 * latitude_rad) +
                             0.118 * std::cos(5 * latitude_rad);
  const double metres_north = 111132.92 - 559.82 * std::cos(2 * latitude_rad) +
                              1.175 * std::cos(4 * latitude_rad) - 0.0023 * std::cos(6 * latitude_rad);
  return {degrees.x * metres_east, degrees.y * metres_north};
}

Spacing cell_in_metres(const EsriHeader& header) {
  return degrees_in_metres({header.cell_x, header.cell_y}, *header.south + header.cell_y * header.rows / 2);
}

}  // namespace heightlight
