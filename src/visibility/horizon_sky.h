#pragma once

#include <optional>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/visibility.h"
#include "visibility/height_mips.h"
#include "visibility/walk_table.h"

namespace heightlight {

/// The sky's share of every receiver, by horizon walks; NaN where the sample is missing.
struct HorizonSky {
  Map ambient_occlusion;  ///< α, [0, 1]
  Map sky_view_factor;    ///< A, [0, 1]
  SkyMoments moments;     ///< those that were wanted
};

/// How much more than the shares is found, and how far occluders count.
struct SkyTask {
  SkyWanted wanted;
  std::optional<Reach> reach;  ///< everywhere, where absent
};

HorizonSky walk_horizon_sky(const Surface& surface, const HeightMips& mips, const WalkOptions& options,
                            bool quiet, const SkyTask& task = {});

/// Bytes per texel of what it returns.
std::uint64_t horizon_sky_bytes(const SkyWanted& wanted);

/// Elevation of the horizon, rad, toward each azimuth (rad, counterclockwise from x), at least that of the
/// tangent plane: [azimuth]. NaN where the sample is missing. A reach is taken to be sharp. Azimuths of
/// `options` are not used.
std::vector<Map> walk_horizons(const Surface& surface, const HeightMips& mips, const WalkOptions& options,
                               const std::vector<double>& azimuths, const std::optional<Reach>& reach,
                               bool quiet);

}  // namespace heightlight
