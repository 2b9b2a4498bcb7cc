#include "terrain/marched_quantities.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/texels.h"
#include "solve/definitions.h"
#include "visibility/horizon_sums.h"
#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

/// Of one texel, over the azimuths so far: A, or the sum of a mean's terms.
struct QuantitySum {
  SkyShareSum sky;
  double terms = 0;
};

/// A texel's normal in the vertical plane of an azimuth.
SliceNormal slice_normal(const Surface& surface, std::size_t texel, double cosine, double sine) {
  const Vector3& normal = surface.normal.values[texel];
  return {double{normal.x} * cosine + double{normal.y} * sine, double{normal.z}};
}

/// Adds what one azimuth sees to every texel's sum.
void add_horizons(const Surface& surface, double azimuth_rad, const Map& slopes,
                  const TerrainQuantity& quantity, Image<QuantitySum>& sums) {
  const double cosine = std::cos(azimuth_rad);
  const double sine = std::sin(azimuth_rad);
  const double lowest =
      quantity.below == BelowHorizontal::ground ? 0 : -std::numeric_limits<double>::infinity();
  const bool of_sky = is_of_sky(quantity.definition);
  for_texels(slopes, [&](std::size_t i) {
    if (std::isnan(slopes.values[i])) return;
    const SliceNormal normal = slice_normal(surface, i, cosine, sine);
    const auto slope = double{slopes.values[i]};
    QuantitySum& sum = sums.values[i];
    if (of_sky) {
      sum.sky.add(normal, std::max(slope, lowest));
    } else {
      sum.terms += horizon_term(mean_of(quantity.definition), slope, tangent_slope(normal));
    }
  });
}

Map to_values(const Surface& surface, const TerrainQuantity& quantity, const Image<QuantitySum>& sums,
              int azimuths) {
  Map map(sums.width, sums.height, std::numeric_limits<float>::quiet_NaN());
  for_texels(map, [&](std::size_t i) {
    if (std::isnan(surface.map.height.values[i])) return;
    const QuantitySum& sum = sums.values[i];
    map.values[i] =
        static_cast<float>(is_of_sky(quantity.definition) ? sum.sky.value() : sum.terms / azimuths);
  });
  return map;
}

}  // namespace

std::vector<QuantityMap> march_quantities(const Surface& surface, int azimuths, MarchOptions march,
                                          const std::vector<TerrainQuantity>& quantities) {
  std::vector<Image<QuantitySum>> sums(quantities.size(),
                                       Image<QuantitySum>(surface.width(), surface.height()));
  std::vector<QuantityMap> found(quantities.size());
  Cost horizons;
  for (const double azimuth : equal_azimuths(azimuths, AzimuthConvention::north)) {
    march.azimuth_rad = azimuth;
    const Stopwatch finding;
    const Map slopes = march_horizon(surface, march);
    horizons = horizons + finding.elapsed();
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const Stopwatch summing;
      add_horizons(surface, azimuth, slopes, quantities[q], sums[q]);
      found[q].cost = found[q].cost + summing.elapsed();
    }
  }
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    found[q].quantity = quantities[q];
    found[q].map = to_values(surface, quantities[q], sums[q], azimuths);
    found[q].cost = found[q].cost + horizons;
  }
  return found;
}

std::uint64_t march_bytes_per_texel(std::size_t quantities) {
  constexpr std::uint64_t kMap = sizeof(Map::value_type);
  return kMap + quantities * (sizeof(QuantitySum) + kMap);
}

}  // namespace heightlight
