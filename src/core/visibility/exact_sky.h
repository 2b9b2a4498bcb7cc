#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "heightlight/visibility.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// All that fast walks find of a receiver's sky, in double precision along exact profiles. NaN where the
/// sample is missing.
struct ExactSky {
  double ambient_occlusion = 1;
  double sky_view_factor = 1;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< as SkyMoments
  std::array<double, 5> second{};
};

/// With a maximum distance, what is seen of the surface counts as open by its own distance: nothing is shared
/// with the horizons of sharp reaches that fast walks take the mean of.
ExactSky find_exact_sky(const ExactWalker& walker, int row, int column,
                        const std::optional<MaximumDistance>& maximum_distance = std::nullopt,
                        BelowHorizontal below = BelowHorizontal::sky);

/// A where there is no sky below the horizontal, of what a receiver sees that is present.
double sky_above_horizontal(const ExactWalker& walker, int row, int column, const SliceView& view);

/// μ(d) of a maximum distance: the share by which an occluder at distance d leaves its direction open.
double open_share(const MaximumDistance& maximum_distance, double distance);

}  // namespace heightlight
