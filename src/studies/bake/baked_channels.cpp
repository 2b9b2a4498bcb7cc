#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "bake/baked_map.h"
#include "bake/bent_cone.h"
#include "base/digits.h"
#include "base/texel_algebra.h"
#include "heightlight/forms.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;
constexpr const char* kPerLength = "1/world length";

/// No coefficient of `sh` is larger: (1/π) ∫ Y² cosθ dω ≤ 0.0995 over all Y of norm 1 and degree 2, whose
/// root bounds ∫ |Y|; degree 1 reaches 0.326, degree 0 0.282.
constexpr double kLargestHarmonic = 1.0 / 3;

BakedChannel share(const char* quantity, const Map& map) {
  return {quantity, "1", 0, 1, 1, [&map](std::size_t i) { return map.values[i]; }};
}

/// x, y, z of a unit vector per texel.
template <class Vector>
std::vector<BakedChannel> unit_vector(bool y_down, Vector&& vector_at) {
  const float up = y_down ? -1 : 1;
  return {{"x", "1", -1, 1, 0, [=](std::size_t i) { return vector_at(i).x; }},
          {"y", "1", -1, 1, 0, [=](std::size_t i) { return up * vector_at(i).y; }},
          {"z", "1", -1, 1, 1, [=](std::size_t i) { return vector_at(i).z; }}};
}

/// Along the first moments. Where nothing of the sky is seen there is no direction but the normal's.
std::vector<BakedChannel> bent_normal_channels(const Material& material, bool y_down) {
  return unit_vector(y_down, [&material](std::size_t i) {
    return bent_normal(material.results.moments.first.values[i], material.surface->normal.values[i]);
  });
}

BakedChannel bent_length(const Material& material) {
  return {"length: 3/2 |first moment|, 1 = open", "1", 0, 1, 1, [&material](std::size_t i) {
            return 1.5F * as_eigen(material.results.moments.first.values[i]).norm();
          }};
}

BakedChannel cone_angle(const Material& material, bool by_spread) {
  return {by_spread ? "half-angle of the cone whose directions are spread as much"
                    : "half-angle of the cone that is as open: acos sqrt(1 - A)",
          "rad",
          0,
          kHalfPi,
          kHalfPi,
          [&material, by_spread](std::size_t i) {
            const auto sky = static_cast<double>(material.results.sky_view_factor.values[i]);
            if (std::isnan(sky)) return std::numeric_limits<float>::quiet_NaN();
            const Vector3& first = material.results.moments.first.values[i];
            return static_cast<float>(by_spread ? cone_of_spread(sky, first) : cone_of_openness(sky));
          }};
}

/// E/π, in colours where it has them.
std::vector<BakedChannel> irradiance(
    std::size_t count, const std::function<float(std::size_t channel, std::size_t i)>& value_at) {
  static constexpr const char* kColour[] = {"E/pi, red", "E/pi, green", "E/pi, blue"};
  std::vector<BakedChannel> channels;
  for (std::size_t c = 0; c < count; ++c) {
    channels.push_back({count == 1 ? "E/pi" : kColour[c], "1", 0, 1, 1,
                        [value_at, c](std::size_t i) { return value_at(c, i); }});
  }
  return channels;
}

std::vector<BakedChannel> totals(const Material& material) {
  return irradiance(material.totals.size(),
                    [&material](std::size_t c, std::size_t i) { return material.totals[c].values[i]; });
}

std::vector<BakedChannel> direct(const Material& material) {
  return irradiance(material.light.channels.size(), [&material](std::size_t c, std::size_t i) {
    const bool present = !std::isnan(material.surface->map.height.values[i]);
    return present ? static_cast<float>(material.light.channels[c][i])
                   : std::numeric_limits<float>::quiet_NaN();
  });
}

std::vector<BakedChannel> horizons(const Material& material, const BakeOptions& options) {
  const bool north = azimuth_convention(options, material.surface->map.boundary) == AzimuthConvention::north;
  const int azimuths = options.horizon_azimuths;
  std::vector<BakedChannel> channels;
  for (int k = 0; k < azimuths; ++k) {
    const std::string degrees = in_digits(360.0 * k / azimuths, 7);
    channels.push_back(
        {"toward " + degrees + (north ? " degrees clockwise from north" : " degrees from x to y"), "rad", 0,
         kHalfPi, 0, [&material, k](std::size_t i) {
           return material.results.horizons[static_cast<std::size_t>(k)].values[i];
         }});
  }
  return channels;
}

Harmonics harmonics_at(const Material& material, bool y_down, std::size_t i) {
  const SkyMoments& moments = material.results.moments;
  std::array<double, 5> second{};
  for (std::size_t k = 0; k < 5; ++k) second[k] = static_cast<double>(moments.second.values[i][k]);
  const Harmonics found =
      harmonics_of_moments(static_cast<double>(material.results.sky_view_factor.values[i]),
                           as_eigen(moments.first.values[i]).cast<double>(), second);
  return y_down ? turn_y(found) : found;
}

std::vector<BakedChannel> harmonics(const Material& material, bool y_down) {
  static constexpr const char* kNames[] = {"Y00", "Y1-1", "Y10", "Y11", "Y2-2", "Y2-1", "Y20", "Y21", "Y22"};
  // Of an open, level place.
  const Harmonics open = harmonics_of_moments(1, {0, 0, 2.0 / 3}, {0, 0, 0.5, 0, 0});
  std::vector<BakedChannel> channels;
  for (std::size_t k = 0; k < 9; ++k) {
    channels.push_back(
        {kNames[k], "1", -kLargestHarmonic, kLargestHarmonic, open[k], [&material, y_down, k](std::size_t i) {
           return static_cast<float>(harmonics_at(material, y_down, i)[k]);
         }});
  }
  return channels;
}

/// Missing samples are those of an open, level place.
BakedChannel of_definition(SkyDefinition definition, const Material& material) {
  const std::vector<DefinitionCheck>& found = material.results.evidence.definition_checks;
  const auto at = std::find_if(found.begin(), found.end(),
                               [&](const DefinitionCheck& check) { return check.definition == definition; });
  const Map& map = material.results.definitions[static_cast<std::size_t>(at - found.begin())];
  const SkyDefinitionFacts& facts = facts_of(definition);
  const bool is_angle = std::string(facts.unit) == "rad";
  const double open = definition == SkyDefinition::terrain_view_factor ? 0 : is_angle ? kHalfPi : 1;
  return {facts.name, facts.unit,
          0,          is_angle ? 2 * kHalfPi : 1,
          open,       [&map](std::size_t i) { return map.values[i]; }};
}

/// Around 0, which becomes the middle level.
BakedChannel signed_detail(const char* quantity, const char* unit, const Map& map, double range) {
  return {quantity, unit, -range, range, 0, [&map](std::size_t i) { return map.values[i]; }};
}

/// What of the curvature has that sign.
BakedChannel curvature_part(const char* quantity, const Material& material, float sign) {
  const LocalMaps& local = material.local;
  return {quantity, kPerLength, 0, local.curvature_range, 0, [&local, sign](std::size_t i) {
            const float curvature = sign * local.curvature.values[i];
            return curvature < 0 ? 0 : curvature;  // NaN stays
          }};
}

BakedChannel displacement(const Material& material, const BakeOptions& options) {
  const Surface& surface = *material.surface;
  const double unit = unit_of(options.displacement_unit).per_metre;
  const double relief = double{surface.highest} - double{surface.lowest};
  const double none = double{surface.lowest} + options.midlevel * relief;
  const double span = relief > 0 ? relief * unit : 1;  // of a level map any will do
  return {"displacement along the flat surface's normal",
          unit_of(options.displacement_unit).name,
          -options.midlevel * span,
          (1 - options.midlevel) * span,
          0,
          [&surface, none, unit](std::size_t i) {
            return static_cast<float>((double{surface.map.height.values[i]} - none) * unit);
          }};
}

/// Slopes times the strength. NaN stays.
std::vector<BakedChannel> normals(const Material& material, const BakeOptions& options) {
  const Surface& surface = *material.surface;
  const auto strength = static_cast<float>(options.normal_strength);
  if (strength == 1)
    return unit_vector(options.y_down, [&surface](std::size_t i) { return surface.normal.values[i]; });
  return unit_vector(options.y_down, [&surface, strength](std::size_t i) {
    const Vector3& own = surface.normal.values[i];
    return to_vector3(Eigen::Vector3f(strength * own.x, strength * own.y, own.z).normalized());
  });
}

BakedChannel height(const Material& material) {
  const Surface& surface = *material.surface;
  const float span = surface.highest - surface.lowest;
  return {"height above the lowest sample, over the relief", "1", 0, 1, 0, [&surface, span](std::size_t i) {
            return span > 0 ? (surface.map.height.values[i] - surface.lowest) / span
                            : surface.map.height.values[i] * 0;
          }};
}

}  // namespace

std::vector<BakedChannel> baked_channels(MaterialMap map, const Material& material,
                                         const BakeOptions& options) {
  std::vector<BakedChannel> channels;
  switch (map) {
    case MaterialMap::ao:
      return {options.uniform_ao ? share("ambient occlusion", material.results.ambient_occlusion)
                                 : share("sky view factor", material.results.sky_view_factor)};
    case MaterialMap::multibounce:
      return totals(material);
    case MaterialMap::direct:
      return direct(material);
    case MaterialMap::bent_normal:
      channels = bent_normal_channels(material, options.y_down);
      if (options.bent_length) channels.push_back(bent_length(material));
      return channels;
    case MaterialMap::bent_cone:
      channels = bent_normal_channels(material, options.y_down);
      channels.push_back(cone_angle(material, false));
      channels.push_back(cone_angle(material, true));
      return channels;
    case MaterialMap::normal:
      return normals(material, options);
    case MaterialMap::ao_n:
      return {share("sky view factor A", material.results.whole_sky_view_factor),
              share("n", material.results.seen)};
    case MaterialMap::horizon:
      return horizons(material, options);
    case MaterialMap::sh:
      return harmonics(material, options.y_down);
    case MaterialMap::height:
      return {height(material)};
    case MaterialMap::specular_occlusion:
      return {share("specular occlusion", material.specular.occlusion)};
    case MaterialMap::curvature:
      return {signed_detail("mean curvature, convex above 0", kPerLength, material.local.curvature,
                            material.local.curvature_range)};
    case MaterialMap::convexity:
      return {curvature_part("mean curvature where it is convex", material, 1)};
    case MaterialMap::concavity:
      return {curvature_part("mean curvature where it is concave", material, -1)};
    case MaterialMap::cavity:
      return {signed_detail("height above the Gaussian mean, over its standard deviation", "1",
                            material.local.cavity, material.local.cavity_range)};
    case MaterialMap::displacement:
      return {displacement(material, options)};
    default:
      return {of_definition(*definition_of(map), material)};
  }
}

}  // namespace heightlight
