#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "files/geo_keys.h"
#include "files/missing_mark.h"

using namespace heightlight;

namespace {

std::optional<MissingMark> mark_of_tag(const std::string& text) {
  const Georeference place{.tags = {make_tag(kGdalNoDataTag, text)}};
  return missing_mark_of({.place = &place});
}

}  // namespace

TEST_CASE("what is missing gets the mark, and what has it or is near to it by chance moves beyond",
          "[files]") {
  for (const float value : {1.0F, 0.0F, -9999.0F, 0.3F}) {
    INFO(value);
    const MissingMark mark{value, ""};
    CHECK(mark_missing(mark, std::nanf("")) == value);
    for (const float sample : {value, std::nextafter(value, 10.0F), std::nextafter(value, -1e5F)}) {
      const float moved = mark_missing(mark, sample);
      if (value == 0 && sample != 0) continue;  // no other sample is near 0
      CHECK(moved > value);
      // GDAL 3.6, ARE_REAL_EQUAL in gcore/gdal_priv.h, with 2 units in the last place
      CHECK(moved - value >= 2 * std::numeric_limits<float>::epsilon() * std::fabs(moved + value));
    }
    CHECK(mark_missing(mark, 0.5F) == 0.5F);
  }
}

TEST_CASE("marks are numbers", "[files]") {
  CHECK(mark_of_tag("-9999")->value == -9999.0F);
  CHECK(std::isnan(mark_of_tag("nan")->value));
  CHECK_FALSE(mark_of_tag("none"));
  CHECK_FALSE(missing_mark_of({}));
}
