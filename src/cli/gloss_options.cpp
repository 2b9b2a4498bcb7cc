#include "cli/gloss_options.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "cli/number_list.h"
#include "heightlight/error.h"
#include "heightlight/gloss.h"

namespace heightlight {

Vector3 parse_view(const std::string& text) {
  const std::optional<std::vector<double>> numbers = parse_number_list(text);
  if (!numbers || numbers->size() != 2)
    throw UsageError("view", text, "must be azimuth and elevation in degrees, such as 135,45");
  constexpr double kRadians = std::numbers::pi / 180;
  const double azimuth = std::numbers::pi / 2 - (*numbers)[0] * kRadians;
  const double elevation = (*numbers)[1] * kRadians;
  if (!((*numbers)[1] > 0 && (*numbers)[1] <= 90))
    throw UsageError("view", text, "must have an elevation above 0 and at most 90 degrees");
  return {static_cast<float>(std::cos(elevation) * std::cos(azimuth)),
          static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
          static_cast<float>(std::sin(elevation))};
}

double parse_roughness(const std::string& text) {
  const std::optional<std::vector<double>> numbers = parse_number_list(text);
  if (!numbers || numbers->size() != 1)
    throw UsageError("roughness", text, "must be a number above 0 and at most 1");
  check_gloss({.roughness = numbers->front()});
  return numbers->front();
}

}  // namespace heightlight
