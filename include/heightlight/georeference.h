#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/heightmap.h"

namespace heightlight {

/// A tag of a TIFF as it stands in its directory, bytes in this machine's order.
struct GeoTag {
  std::uint16_t number = 0;
  std::uint16_t type = 0;  ///< of its values: 2 text, with its final 0; 3 unsigned 16 bits; 12 double
  std::string bytes;

  friend bool operator==(const GeoTag&, const GeoTag&) = default;
};

/// Where a map lies on earth, as its file says it. Columns run east and rows run south along the axes of the
/// file's coordinates.
struct Georeference {
  /// x and y of the outer corner of the first sample, in the file's coordinates; absent where it tells none.
  std::optional<std::array<double, 2>> corner = {};
  Spacing cell = {};                         ///< distance between samples in the file's coordinates
  bool in_degrees = false;                   ///< these are longitudes and latitudes
  std::optional<double> metres = {};         ///< length of their unit, where they are lengths of a known unit
  std::optional<double> height_metres = {};  ///< length of the heights' unit, where the file tells it
  /// Of the ellipsoid that degrees are of, in metres, where the file tells it: 1737400 of the moon.
  std::optional<double> equator_radius = {};
  std::string system = {};  ///< of coordinates, as the file names it: "EPSG:32631"; empty where it names none
  std::string projection = {};    ///< text of the .prj file beside it; empty where there is none
  std::vector<GeoTag> tags = {};  ///< what says all this in a GeoTIFF, its no-data included
};

}  // namespace heightlight
