#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/sky_light.h"
#include "heightlight/solve.h"

namespace heightlight {

/// An albedo that totals are compared at.
struct ComparedAlbedo {
  std::string label;        ///< "0.5"; a channel's name where it varies
  TexelVector reflectance;  ///< per texel, in [0, 1]
  Map varying = {};         ///< the same as a map; 0 × 0 where it is the same everywhere

  bool constant() const { return varying.size() == 0; }

  /// As a request has it.
  Albedo albedo() const {
    if (constant()) return {.constant = {reflectance[0]}};
    return {.varying = {reflectance}};
  }
};

/// A sky that is not the same all over, under which direct irradiance is compared.
struct ComparedSky {
  std::string quantity = "two_tone_irradiance";  ///< as the table has it
  std::string label = "a sky warm where y > 0, cold elsewhere";
  SkyLight light = normalised(two_tone_sky());
};

struct ReferenceOptions {
  int azimuths = 128;  ///< of the exact walk that every texel makes
  ComparedSky sky = {};
  std::vector<ComparedAlbedo> albedos;
  std::uint64_t memory = ~0ULL;  ///< bytes that the sky's slices, and then finding the totals, may take
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// What methods are compared with, and what it errs by itself.
struct ComparisonReference {
  int azimuths = 0;
  Map ambient_occlusion;  ///< α, by exact walks
  Map sky_view_factor;    ///< A, likewise
  Image<Vector3> bent_normal;
  ComparedSky sky;
  Image<Vector3> sky_light;  ///< E/π under that sky, by exact walks
  std::vector<Map> totals;   ///< E/π per albedo, by planned horizon walks
  Map seen;                  ///< n, from the total at kSeenAlbedo, likewise
  Cost cost;                 ///< of the exact walks
  Cost total_cost;
  Evidence total_evidence;  ///< of the totals

  int checked = 0;           ///< receivers that the following was found on
  double sky_rmse = 0;       ///< of A, against exact walks along kCheckAzimuths azimuths
  double bent_rmse_deg = 0;  ///< of the bent normal, likewise
  double ray_rmse = 0;       ///< of A, against kCheckRays rays, which share no code with the walks; their own
                             ///< error is in it
};

constexpr int kCheckAzimuths = 1024;
constexpr int kCheckRays = 65536;

ComparisonReference build_reference(const Surface& surface, const ReferenceOptions& options);

}  // namespace heightlight
