#pragma once

#include <functional>
#include <optional>

#include "heightlight/evidence.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// What is checked: maps of the sky, moments where there are any; and of what sky they are.
struct CheckedSky {
  const Map& ambient_occlusion;
  const Map& sky_view_factor;
  const SkyMoments& moments;
  const std::optional<MaximumDistance>& maximum_distance;
  BelowHorizontal below;
};

/// `seed` picks the receivers. Nothing where none is present.
std::optional<SkyCheck> check_sky(const Surface& surface, const CheckedSky& sky, std::uint64_t seed,
                                  const Watch& watch = {});

/// What was found of one receiver.
struct CheckedReceiver {
  float ambient_occlusion = 0;
  float sky_view_factor = 0;
  SkyMoments moments = {};  ///< maps of one texel, or empty
};

struct SkyCheckOptions {
  std::optional<MaximumDistance> maximum_distance = {};
  BelowHorizontal below = BelowHorizontal::sky;
  std::uint64_t seed = 1;
  int first_row = 0;  ///< of the part of the map that the receivers are picked from
  int first_column = 0;
  int rows = 0;  ///< 0: all of it
  int columns = 0;
  Watch watch = {};
};

/// Azimuths of check_sky's exact walks.
constexpr int kSkyCheckAzimuths = 256;

/// The same by a walker of one's own, of what was found wherever it is kept; asked from many threads.
std::optional<SkyCheck> check_receivers_sky(const ExactWalker& walker,
                                            const std::function<CheckedReceiver(int row, int column)>& found,
                                            const SkyCheckOptions& options);

}  // namespace heightlight
