#pragma once

#include <optional>

#include "heightlight/bake.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// What a sky's maps err by on receivers picked by a hash, against exact profiles along many azimuths. RMS;
/// absent where it was not wanted.
struct SkyCheck {
  int receivers = 0;
  int azimuths = 0;
  double ambient_occlusion = 0;
  double sky_view_factor = 0;
  std::optional<double> bent_normal_rad;  ///< angle
  std::optional<double> harmonics;        ///< of a coefficient
};

/// `seed` picks the receivers. Nothing where none is present.
std::optional<SkyCheck> check_sky(const Surface& surface, const HorizonSky& sky,
                                  const std::optional<Reach>& reach, std::uint64_t seed);

}  // namespace heightlight
