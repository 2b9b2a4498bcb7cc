#include <numbers>

#include "heightlight/error.h"
#include "heightlight/visibility.h"

namespace heightlight {

BelowHorizontal below_horizontal_named(const std::string& name) {
  if (name == "sky") return BelowHorizontal::sky;
  if (name == "ground") return BelowHorizontal::ground;
  throw UsageError("below_horizontal", name, "must be sky or ground");
}

AzimuthConvention azimuth_convention_named(const std::string& name) {
  if (name == "math") return AzimuthConvention::math;
  if (name == "north") return AzimuthConvention::north;
  throw UsageError("azimuth_convention", name, "must be north or math");
}

std::vector<double> equal_azimuths(int count, AzimuthConvention convention) {
  std::vector<double> azimuths;
  for (int k = 0; k < count; ++k) {
    const double turned = 2 * std::numbers::pi * k / count;
    azimuths.push_back(convention == AzimuthConvention::north ? std::numbers::pi / 2 - turned : turned);
  }
  return azimuths;
}

const std::vector<SkyDefinitionFacts>& sky_definitions() {
  static const std::vector<SkyDefinitionFacts> kDefinitions{
      {SkyDefinition::svf_tilted, "svf-tilted", "(1/pi) int V cos(theta) dw, theta from the surface's normal",
       "1"},
      {SkyDefinition::svf_horizontal, "svf-horizontal", "mean cos^2 h, h >= 0: of a level receiver", "1"},
      {SkyDefinition::svf_solid_angle, "svf-solid-angle",
       "1 - mean sin h, h >= 0 (Zaksek, Ostir and Kokalj 2011)", "1"},
      {SkyDefinition::openness_positive, "openness-positive",
       "mean of pi/2 - h, in rad (Yokoyama, Shirasawa and Pike 2002)", "rad"},
      {SkyDefinition::openness_negative, "openness-negative",
       "the same of the surface turned upside down, in rad", "rad"},
      {SkyDefinition::mean_cos_h, "mean-cos-h", "mean cos h, h >= 0", "1"},
      {SkyDefinition::terrain_view_factor, "terrain-view-factor", "1 - svf-tilted", "1"}};
  return kDefinitions;
}

const SkyDefinitionFacts& facts_of(SkyDefinition definition) {
  return sky_definitions()[static_cast<std::size_t>(definition)];
}

SkyDefinition sky_definition_named(const std::string& name) {
  std::string known;
  for (const SkyDefinitionFacts& facts : sky_definitions()) {
    if (name == facts.name) return facts.definition;
    known += (known.empty() ? "" : ", ") + std::string(facts.name);
  }
  throw UsageError("definition", name, "is none of " + known);
}

}  // namespace heightlight
