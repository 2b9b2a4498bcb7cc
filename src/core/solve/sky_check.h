#pragma once

#include <optional>

#include "heightlight/evidence.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"

namespace heightlight {

/// What is checked: maps of the sky, moments where there are any; and of what sky they are.
struct CheckedSky {
  const Map& ambient_occlusion;
  const Map& sky_view_factor;
  const SkyMoments& moments;
  const std::optional<Reach>& reach;
  BelowHorizontal below;
};

/// `seed` picks the receivers. Nothing where none is present.
std::optional<SkyCheck> check_sky(const Surface& surface, const CheckedSky& sky, std::uint64_t seed,
                                  const Watch& watch = {});

}  // namespace heightlight
