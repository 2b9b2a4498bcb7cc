#include "files/missing_mark.h"

#include <cmath>

#include "files/geo_keys.h"
#include "files/no_data.h"

namespace heightlight {

std::optional<MissingMark> missing_mark_of(const TextureLayout& layout) {
  const GeoTag* tag = layout.place ? find_tag(layout.place->tags, kGdalNoDataTag) : nullptr;
  if (!tag) return std::nullopt;
  const std::string text = text_of(*tag);
  const std::optional<double> value = parse_no_data(text);
  if (!value) return std::nullopt;
  return MissingMark{static_cast<float>(*value), text};
}

float mark_missing(const MissingMark& mark, float sample) {
  if (std::isnan(sample)) return mark.value;
  if (!std::isfinite(mark.value)) return sample;
  constexpr float kNear = 1e-6F;
  const float near = kNear * std::fabs(mark.value);
  return std::fabs(sample - mark.value) <= near ? std::nextafter(mark.value + near, HUGE_VALF) : sample;
}

}  // namespace heightlight
