#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "heightlight/surface.h"

namespace heightlight {

/// Seed of the sample that sets the classes' bounds; checks use seeds of their own.
constexpr std::uint64_t kSkyClassesSeed = 1;

/// Classes of receivers by A, with about as many receivers in each. The error of a total depends on A more
/// than on anything else: means over a class keep this error, and average out the noise of few azimuths.
class SkyClasses {
 public:
  static constexpr std::size_t kCount = 16;
  template <class T>
  using PerClass = std::array<T, kCount>;

  /// `sky` is A per texel, as a TexelVector or as the values of a map. The bounds are quantiles over a sample
  /// of the surface's receivers, picked by the seed.
  template <class Values>
  SkyClasses(const Surface& surface, const Values& sky, std::uint64_t seed) {
    std::vector<double> sample;
    for (const std::size_t texel : sample_receivers(surface, seed)) sample.push_back(double{sky[texel]});
    set_bounds(std::move(sample));
  }

  /// Takes A of a sample of the receivers, in any order.
  explicit SkyClasses(std::vector<double> sample) { set_bounds(std::move(sample)); }

  std::size_t of(double sky) const;

  /// Texels picked from a map of `texels` texels; those that are present are the sample.
  static std::vector<std::size_t> sample_texels(std::int64_t texels, std::uint64_t seed);
  /// The picked texels of a surface that are present.
  static std::vector<std::size_t> sample_receivers(const Surface& surface, std::uint64_t seed);

 private:
  void set_bounds(std::vector<double> sample);

  std::vector<double> bounds_;
};

/// The i-th of `count` picked texels: one from each of `count` equal parts of a map of `texels` texels.
std::size_t pick_texel(std::int64_t i, std::int64_t count, std::int64_t texels, std::uint64_t seed);

}  // namespace heightlight
