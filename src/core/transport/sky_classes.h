#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Of the sample that classes are made by, but for checks, whose sample is their own.
constexpr std::uint64_t kSkyClassesSeed = 1;

/// Classes of receivers by A, about as many in each. What is wrong with a total depends on A more than on
/// anything else: means over a class keep it, and lose the noise of few azimuths.
class SkyClasses {
 public:
  static constexpr std::size_t kCount = 16;
  template <class T>
  using PerClass = std::array<T, kCount>;

  /// `sky`: A per texel, as TexelVector or the values of a map. The bounds are quantiles over a sample of the
  /// surface's receivers, picked by the seed.
  template <class Values>
  SkyClasses(const Surface& surface, const Values& sky, std::uint64_t seed) {
    std::vector<double> sample;
    for (const std::size_t texel : sample_receivers(surface, seed)) sample.push_back(double{sky[texel]});
    set_bounds(std::move(sample));
  }

  /// By A of a sample of the receivers, in any order.
  explicit SkyClasses(std::vector<double> sample) { set_bounds(std::move(sample)); }

  std::size_t of(double sky) const;

  /// Texels of a map of so many, of which those that are present are the sample.
  static std::vector<std::size_t> sample_texels(std::int64_t texels, std::uint64_t seed);
  /// Of a surface, those that are.
  static std::vector<std::size_t> sample_receivers(const Surface& surface, std::uint64_t seed);

 private:
  void set_bounds(std::vector<double> sample);

  std::vector<double> bounds_;
};

/// The i-th of `count` texels, one from each of as many equal parts of a map of `texels`.
std::size_t pick_texel(std::int64_t i, std::int64_t count, std::int64_t texels, std::uint64_t seed);

}  // namespace heightlight
