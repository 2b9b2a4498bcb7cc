#include "visibility/walk_route.h"

namespace heightlight {

std::vector<double> walked_azimuths(const WalkOptions& options) {
  std::vector<double> azimuths;
  for (int k = 0; k < options.azimuths; ++k) azimuths.push_back(azimuth_rad(options, k));
  return azimuths;
}

std::vector<TileFrame> all_tiles(const Surface& surface) {
  const TileGrid grid(surface.width(), surface.height());
  std::vector<TileFrame> tiles;
  for (std::int64_t i = 0; i < grid.count(); ++i) tiles.push_back(grid.frame(i));
  return tiles;
}

Route plan_route(const Surface& surface, const WalkOptions& options, const std::vector<double>& azimuths,
                 const std::optional<MaximumDistance>& maximum_distance) {
  Route route{{}, ring_count(surface, options)};
  if (maximum_distance) {
    check_maximum_distance(*maximum_distance);
    route.rings = rings_within(surface, options, maximum_distance->distance, route.rings);
  }
  for (const double azimuth : azimuths) {
    RouteAzimuth& made = route.azimuths.emplace_back();
    made.table = make_azimuth_table(surface, options, azimuth);
    made.table.rings.resize(static_cast<std::size_t>(route.rings));
    if (maximum_distance) made.maximum_distance = make_distance_table(made.table, *maximum_distance);
  }
  return route;
}

}  // namespace heightlight
