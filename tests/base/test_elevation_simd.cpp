#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/test_elevation_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "base/elevation-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

/// Elevations of as many slopes as whole vectors hold: cosines, sines, angles from the zenith.
void find_elevations(const std::vector<float>& slopes, std::vector<float>& cosines, std::vector<float>& sines,
                     std::vector<float>& from_zenith) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<float, 16> d;
  for (std::size_t i = 0; i + hn::Lanes(d) <= slopes.size(); i += hn::Lanes(d)) {
    const auto found = elevation(d, hn::LoadU(d, slopes.data() + i));
    hn::StoreU(found.cosine, d, cosines.data() + i);
    hn::StoreU(found.sine, d, sines.data() + i);
    hn::StoreU(found.from_zenith, d, from_zenith.data() + i);
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <catch2/catch.hpp>

#include "visibility/walked_tiles.h"

namespace heightlight {

HWY_EXPORT(find_elevations);

namespace {

TEST_CASE("elevations of slopes are right to 3e-7, and level ones exactly, on every instruction set",
          "[base]") {
  std::vector<float> slopes{0.0F, -0.0F, 1.0F, -1.0F, 1e30F, -1e30F, 1e-30F, 1e-40F};
  for (double size = 1e-12; size < 1e17; size *= 1.013) {
    slopes.push_back(static_cast<float>(size));
    slopes.push_back(static_cast<float>(-size));
  }
  while (slopes.size() % 16 != 0) slopes.push_back(0.5F);
  std::vector<float> cosines(slopes.size());
  std::vector<float> sines(slopes.size());
  std::vector<float> from_zenith(slopes.size());
  for (const std::int64_t target : instruction_sets()) {
    const InstructionSet use(target);
    INFO(hwy::TargetName(target));
    HWY_DYNAMIC_DISPATCH(find_elevations)(slopes, cosines, sines, from_zenith);
    CHECK(cosines[0] == 1);
    CHECK(sines[0] == 0);
    CHECK(from_zenith[0] == std::numbers::pi_v<float> / 2);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      INFO(slopes[i]);
      const double slope = double{slopes[i]};
      const double cosine = 1 / std::hypot(1, slope);
      REQUIRE(std::fabs(double{cosines[i]} - cosine) <= 2e-7 * cosine + 1.1e-18);  // 1e-18 from 1e18 on
      REQUIRE(std::fabs(double{sines[i]} - slope * cosine) <= 2e-7);
      REQUIRE(std::fabs(sines[i]) <= 1);
      REQUIRE(std::fabs(double{from_zenith[i]} - (std::numbers::pi / 2 - std::atan(slope))) <= 3e-7);
    }
  }
}

}  // namespace
}  // namespace heightlight
#endif
