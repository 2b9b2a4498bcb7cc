#include "transport/sky_classes.h"

#include <algorithm>
#include <cmath>

#include "base/hash.h"

namespace heightlight {

std::size_t SkyClasses::of(double sky) const {
  return static_cast<std::size_t>(std::upper_bound(bounds_.begin(), bounds_.end(), sky) - bounds_.begin());
}

std::vector<std::size_t> SkyClasses::sample_texels(std::int64_t texels, std::uint64_t seed) {
  constexpr std::int64_t kSample = 4096;
  const std::int64_t count = std::min(kSample, texels);
  std::vector<std::size_t> sample;
  for (std::int64_t i = 0; i < count; ++i) sample.push_back(pick_texel(i, count, texels, seed));
  return sample;
}

std::vector<std::size_t> SkyClasses::sample_receivers(const Surface& surface, std::uint64_t seed) {
  const Image<float>& heights = surface.map.height;
  std::vector<std::size_t> sample = sample_texels(static_cast<std::int64_t>(heights.size()), seed);
  std::erase_if(sample, [&](std::size_t texel) { return std::isnan(heights.values[texel]); });
  return sample;
}

void SkyClasses::set_bounds(std::vector<double> sample) {
  std::sort(sample.begin(), sample.end());
  for (std::size_t k = 0; k + 1 < kCount && !sample.empty(); ++k)
    bounds_.push_back(sample[(k + 1) * sample.size() / kCount]);
}

std::size_t pick_texel(std::int64_t i, std::int64_t count, std::int64_t texels, std::uint64_t seed) {
  const std::int64_t begin = texels * i / count;
  const std::int64_t end = texels * (i + 1) / count;
  const std::uint64_t pick = hash_combine(seed, static_cast<std::uint64_t>(i));
  return static_cast<std::size_t>(begin) +
         static_cast<std::size_t>(pick % static_cast<std::uint64_t>(end - begin));
}

}  // namespace heightlight
