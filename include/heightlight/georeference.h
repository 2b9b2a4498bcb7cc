#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/heightmap.h"

namespace heightlight {

/// A tag of a TIFF as it stands in the file's directory, with its bytes in the byte order of this machine.
struct GeoTag {
  std::uint16_t number = 0;
  /// Type of its values: 2 is text, with its final 0; 3 is unsigned 16 bits; 12 is double.
  std::uint16_t type = 0;
  std::string bytes;

  friend bool operator==(const GeoTag&, const GeoTag&) = default;
};

/// Where a map lies on earth, as its file says. Columns run east and rows run south, along the axes of the
/// file's coordinates.
struct Georeference {
  /// x and y of the outer corner of the first sample, in the file's coordinates; absent where the file gives
  /// none.
  std::optional<std::array<double, 2>> corner = {};
  Spacing cell = {};        ///< distance between neighbouring samples, in the file's coordinates
  bool in_degrees = false;  ///< the coordinates are longitudes and latitudes, in degrees
  /// Metres per unit of the coordinates; absent for degrees, and for lengths of an unknown unit.
  std::optional<double> metres = {};
  /// Metres per unit of the heights; absent where the file does not give it.
  std::optional<double> height_metres = {};
  /// Equatorial radius in metres of the ellipsoid that degrees refer to, such as 1737400 for the moon; absent
  /// where the file does not give it.
  std::optional<double> equator_radius = {};
  /// Coordinate system as the file names it: "EPSG:32631"; empty where the file names none.
  std::string system = {};
  /// Text of the .prj file beside the map, or the well-known text among a GeoTIFF's keys; empty where there
  /// is neither.
  std::string projection = {};
  /// The GeoTIFF tags that say all of this, the no-data value included.
  std::vector<GeoTag> tags = {};
};

}  // namespace heightlight
