#include "terrain/horizon_means.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "base/texels.h"
#include "heightlight/solve.h"
#include "terrain/texel_slices.h"

namespace heightlight {
namespace {

using std::numbers::pi;

constexpr std::size_t kAtOnce = 8;  // maps of horizons that are held

/// Adds what one azimuth sees to every texel's sum.
void add_horizons(const Surface& surface, double azimuth_rad, const Map& slopes, TerrainSky definition,
                  Image<SkySum>& sums) {
  const AzimuthDirection azimuth(azimuth_rad);
  for_texels(slopes, [&](std::size_t i) {
    if (!std::isnan(slopes.values[i]))
      sums.values[i].add(definition, slice_normal(surface, i, azimuth), double{slopes.values[i]});
  });
}

Map to_values(const Surface& surface, const Image<SkySum>& sums) {
  Map map(sums.width, sums.height, std::numeric_limits<float>::quiet_NaN());
  for_texels(map, [&](std::size_t i) {
    if (!std::isnan(surface.map.height.values[i])) map.values[i] = static_cast<float>(sums.values[i].value());
  });
  return map;
}

}  // namespace

std::vector<DefinitionMap> sum_definitions(const Surface& surface, const std::vector<double>& azimuths_rad,
                                           const std::vector<TerrainSky>& definitions,
                                           const HorizonFinder& find_horizons) {
  std::vector<Image<SkySum>> sums(definitions.size(), Image<SkySum>(surface.width(), surface.height()));
  std::vector<DefinitionMap> found(definitions.size());
  Cost horizons;
  for (std::size_t begin = 0; begin < azimuths_rad.size(); begin += kAtOnce) {
    const std::size_t end = std::min(begin + kAtOnce, azimuths_rad.size());
    const auto at = [&](std::size_t k) { return azimuths_rad.begin() + static_cast<std::ptrdiff_t>(k); };
    const std::vector<double> some(at(begin), at(end));
    const Stopwatch finding;
    const std::vector<Map> slopes = find_horizons(some);
    horizons = horizons + finding.elapsed();
    for (std::size_t d = 0; d < definitions.size(); ++d) {
      const Stopwatch summing;
      for (std::size_t k = 0; k < some.size(); ++k)
        add_horizons(surface, some[k], slopes[k], definitions[d], sums[d]);
      found[d].cost = found[d].cost + summing.elapsed();
    }
  }
  for (std::size_t d = 0; d < definitions.size(); ++d) {
    found[d].definition = definitions[d];
    found[d].map = to_values(surface, sums[d]);
    found[d].cost = found[d].cost + horizons;
  }
  return found;
}

std::uint64_t definition_bytes_per_texel(std::size_t definitions) {
  constexpr std::uint64_t kMap = sizeof(Map::value_type);
  return kAtOnce * kMap + definitions * (sizeof(SkySum) + kMap);
}

std::vector<DefinitionMap> march_definitions(const Surface& surface, int azimuths, MarchOptions march,
                                             const std::vector<TerrainSky>& definitions) {
  std::vector<double> azimuths_rad;
  for (int k = 0; k < azimuths; ++k) azimuths_rad.push_back(pi / 2 - 2 * pi * k / azimuths);
  return sum_definitions(surface, azimuths_rad, definitions, [&](const std::vector<double>& some) {
    std::vector<Map> slopes;
    for (const double azimuth : some) {
      march.azimuth_rad = azimuth;
      slopes.push_back(march_horizon(surface, march));
    }
    return slopes;
  });
}

std::vector<DefinitionMap> walk_definitions(const Surface& surface, int azimuths,
                                            const std::vector<TerrainSky>& definitions, const Watch& watch) {
  std::vector<double> azimuths_rad;
  for (int k = 0; k < azimuths; ++k) azimuths_rad.push_back(2 * pi * (k + 0.25) / azimuths);
  return sum_definitions(surface, azimuths_rad, definitions, [&](const std::vector<double>& some) {
    Request request;
    request.wanted.horizon_rad = some;
    request.accuracy.plan = HorizonPlan{};
    request.watch = watch;
    std::vector<Map> slopes = solve(surface, request).horizons;
    for (Map& map : slopes) {
      for_texels(map, [&](std::size_t i) { map.values[i] = std::tan(map.values[i]); });
    }
    return slopes;
  });
}

}  // namespace heightlight
