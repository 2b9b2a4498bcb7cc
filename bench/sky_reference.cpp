#include "sky_reference.h"

#include "ray_methods.h"

namespace heightlight {

SkyReference make_sky_reference(const Surface& surface, int count) {
  // Neither seed is that of a method under test, so that errors do not cancel.
  constexpr std::uint64_t kSeeds[] = {101, 102};
  SkyReference result;
  ReferenceValues& reference = result.reference;
  reference.receivers = pick_receivers(surface, count);
  const auto run = [&](std::uint64_t seed) {
    return trace_sky(RayCaster(surface, {.rays = 65536, .seed = seed}), reference.receivers);
  };
  const std::vector<float> one = run(kSeeds[0]);
  const std::vector<float> other = run(kSeeds[1]);
  for (std::size_t i = 0; i < one.size(); ++i) reference.values.push_back((one[i] + other[i]) / 2);
  result.own_rmse = rmse(one, other) / 2;
  return result;
}

}  // namespace heightlight
