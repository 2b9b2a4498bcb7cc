#include "files/ground_spacing.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "files/degrees.h"

namespace heightlight {
namespace {

Spacing scaled(const Spacing& spacing, double factor) { return {spacing.x * factor, spacing.y * factor}; }

/// Size of a cell in metres. The width is 0 at the poles and beyond, where cells end whose samples lie on a
/// pole.
Spacing cell_at(const Spacing& cell, double latitude) {
  constexpr double kPole = 90;
  Spacing metres = degrees_in_metres(cell, std::clamp(latitude, -kPole, kPole));
  if (std::fabs(latitude) >= kPole) metres.x = 0;
  return metres;
}

/// Whether an ellipsoid may be the Earth's. All such ellipsoids have an equatorial radius within 2 km of this
/// one, and spheres of the Earth's mean radius within 8 km.
bool is_earth(double equator_radius) { return std::fabs(equator_radius - 6378137) < 1e4; }

/// Describes how much the cell width varies from north to south, if by 1 % or more.
std::string describe_change(const Spacing& cell, double north, double south) {
  constexpr double kShows = 0.01;
  const double upper = cell_at(cell, north).x;
  const double lower = cell_at(cell, south).x;
  if (std::fabs(upper - lower) < kShows * (upper + lower) / 2) return "";
  return fmt::format("; from north to south they {} from {:.4g} to {:.4g} m",
                     upper < lower ? "widen" : "narrow", upper, lower);
}

Spacing measure_degrees(const Georeference& place, int rows, std::vector<Warning>& warnings) {
  const double north = (*place.corner)[1];
  const double south = north - rows * place.cell.y;
  const double middle = (north + south) / 2;
  const Spacing metres = degrees_in_metres(place.cell, middle);
  warnings.push_back({fmt::format(
      "its cells of {:.6g} x {:.6g} degrees are {:.4g} x {:.4g} m at its middle "
      "latitude of {:.4g} (WGS 84), which is taken as the spacing{}",
      place.cell.x, place.cell.y, metres.x, metres.y, middle, describe_change(place.cell, north, south))});
  return metres;
}

}  // namespace

Spacing spacing_on_ground(const InputFile& file, const Georeference& place, int rows,
                          std::vector<Warning>& warnings) {
  const double height_unit = place.height_metres.value_or(1);
  if (place.in_degrees) {
    if (!place.corner)
      throw file.error("has cells in degrees, and does not tell where; give the spacing in metres", "texel");
    if (place.equator_radius && !is_earth(*place.equator_radius))
      throw file.error(
          fmt::format("has cells in degrees of a body that is not the Earth (its radius is {:g} m); "
                      "give the spacing in metres",
                      *place.equator_radius),
          "texel");
    return scaled(measure_degrees(place, rows, warnings), 1 / height_unit);
  }
  if (!place.metres) return place.cell;
  if (*place.metres != 1 && !place.height_metres)
    throw file.error(
        fmt::format("has cells of {:g} x {:g} units of {:g} m, and does not tell the unit of its heights; "
                    "give the spacing in that unit",
                    place.cell.x, place.cell.y, *place.metres),
        "texel");
  return scaled(place.cell, *place.metres / height_unit);
}

}  // namespace heightlight
