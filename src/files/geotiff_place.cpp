#include "files/geotiff_place.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/geo_keys.h"

namespace heightlight {
namespace {

/// The mapping from columns and rows to coordinates: x = x0 + scale_x column, y = y0 − scale_y row.
struct GridPlace {
  Spacing scale;
  std::optional<std::array<double, 2>> origin;
};

bool is_length(double value) { return value > 0 && std::isfinite(value); }

/// Reads ModelTransformationTag: four rows of four; x = a column + b row + d, y = e column + f row + h.
GridPlace read_transformation(const std::vector<double>& m, std::string& fault) {
  if (m.size() != 16 || !std::all_of(m.begin(), m.end(), [](double v) { return std::isfinite(v); })) {
    fault = "its transformation does not have 16 numbers";
  } else if (m[1] != 0 || m[4] != 0) {
    fault = "its grid is rotated or sheared; warp it to a north-up one first";
  } else if (m[5] > 0) {
    fault = "its rows run from south to north; turn it over first";
  } else if (!is_length(m[0]) || !is_length(-m[5])) {
    fault = "its transformation has a scale that is not positive";
  } else {
    return {{m[0], -m[5]}, {{m[3], m[7]}}};
  }
  return {};
}

/// Reads ModelPixelScaleTag, and the first point of ModelTiepointTag: column, row, 0, x, y, 0.
GridPlace read_scale(const std::vector<double>& scale, const GeoTag* tie, std::string& fault) {
  if (scale.size() != 3 || !is_length(scale[0]) || !is_length(scale[1])) {
    fault = "its pixel scale is not two positive lengths";
    return {};
  }
  GridPlace place{{scale[0], scale[1]}, std::nullopt};
  if (!tie) return place;
  const std::vector<double> at = doubles_of(*tie);
  if (at.size() != 6 || !std::all_of(at.begin(), at.end(), [](double v) { return std::isfinite(v); })) {
    fault = at.size() > 6 ? "it has several tie points beside a pixel scale, which contradict each other"
                          : "its tie point does not have six numbers";
    return {};
  }
  place.origin = {{at[3] - at[0] * scale[0], at[4] + at[1] * scale[1]}};
  return place;
}

bool agree(const GridPlace& a, const GridPlace& b) {
  const auto near = [&](double x, double y) {
    return std::fabs(x - y) <= 1e-6 * std::max(a.scale.x, a.scale.y);
  };
  return near(a.scale.x, b.scale.x) && near(a.scale.y, b.scale.y) &&
         (!a.origin || !b.origin ||
          (near((*a.origin)[0], (*b.origin)[0]) && near((*a.origin)[1], (*b.origin)[1])));
}

std::optional<GridPlace> read_grid_place(const std::vector<GeoTag>& tags, std::string& fault) {
  const GeoTag* scale = find_tag(tags, kPixelScaleTag);
  const GeoTag* tie = find_tag(tags, kTiePointTag);
  const GeoTag* transformation = find_tag(tags, kTransformationTag);
  if (!scale && !transformation) {
    if (tie)
      fault = doubles_of(*tie).size() > 6 ? "it is placed by control points; warp it to a grid first"
                                          : "it has a tie point, and no pixel scale";
    return std::nullopt;
  }
  std::optional<GridPlace> place;
  if (transformation) place = read_transformation(doubles_of(*transformation), fault);
  if (scale && fault.empty()) {
    const GridPlace scaled = read_scale(doubles_of(*scale), tie, fault);
    if (fault.empty() && place && !agree(*place, scaled))
      fault = "its pixel scale and its transformation contradict each other";
    if (!place) place = scaled;
  }
  return place;
}

void check_latitudes(const Georeference& place, int rows, std::string& fault) {
  if (!place.in_degrees || !place.corner) return;
  constexpr double kPole = 90;
  const double slack = place.cell.y;
  const double north = (*place.corner)[1];
  if (north > kPole + slack || north - rows * place.cell.y < -kPole - slack)
    fault = "its coordinates are said to be degrees, and its latitudes lie beyond the poles";
}

/// Replaces the tags of the corner and the cell size.
void set_place_tags(Georeference& place) {
  std::string fault;
  const double half = read_geo_keys(place.tags, fault).point_samples ? 0.5 : 0;
  std::erase_if(place.tags, [](const GeoTag& tag) {
    return tag.number == kPixelScaleTag || tag.number == kTiePointTag || tag.number == kTransformationTag;
  });
  place.tags.push_back(make_tag(kPixelScaleTag, std::vector<double>{place.cell.x, place.cell.y, 0}));
  if (!place.corner) return;
  place.tags.push_back(
      make_tag(kTiePointTag, std::vector<double>{0, 0, 0, (*place.corner)[0] + half * place.cell.x,
                                                 (*place.corner)[1] - half * place.cell.y, 0}));
}

}  // namespace

GeotiffPlace read_geotiff_place(const std::vector<GeoTag>& tags, int rows) {
  GeotiffPlace read;
  const std::optional<GridPlace> grid = read_grid_place(tags, read.fault);
  if (!read.fault.empty() || !grid) return read;
  const GeoKeys keys = read_geo_keys(tags, read.fault);
  if (!read.fault.empty()) return read;
  Georeference place{.corner = grid->origin,
                     .cell = grid->scale,
                     .in_degrees = keys.in_degrees,
                     .metres = keys.metres,
                     .height_metres = keys.height_metres,
                     .equator_radius = keys.equator_radius,
                     .system = keys.system,
                     .projection = keys.projection,
                     .tags = tags};
  if (place.corner && keys.point_samples) {
    (*place.corner)[0] -= place.cell.x / 2;
    (*place.corner)[1] += place.cell.y / 2;
  }
  check_latitudes(place, rows, read.fault);
  if (read.fault.empty()) read.place = std::move(place);
  return read;
}

Georeference shrink_place(const Georeference& place, int factor) {
  Georeference shrunk = place;
  if (factor == 1) return shrunk;
  shrunk.cell = {factor * place.cell.x, factor * place.cell.y};
  set_place_tags(shrunk);
  return shrunk;
}

Georeference crop_place(const Georeference& place, int row, int column) {
  Georeference cropped = place;
  if (!place.corner || (row == 0 && column == 0)) return cropped;
  cropped.corner = {{(*place.corner)[0] + column * place.cell.x, (*place.corner)[1] - row * place.cell.y}};
  set_place_tags(cropped);
  return cropped;
}

}  // namespace heightlight
