#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "heightlight/visibility.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// All that fast walks find about a receiver's sky, computed in double precision along exact profiles. NaN
/// where the sample is missing.
struct ExactSky {
  double ambient_occlusion = 1;
  double sky_view_factor = 1;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< `first` and `second` are as in SkyMoments
  std::array<double, 5> second{};
};

/// Finds the sky of the receiver at (row, column). With a maximum distance, each visible place of the surface
/// counts as open by the share μ of its own distance, which is integrated finely along each visible stretch.
/// (With a falloff, fast walks take μ at two angles per stretch instead: distance_table.h.)
ExactSky find_exact_sky(const ExactWalker& walker, int row, int column,
                        const std::optional<MaximumDistance>& maximum_distance = std::nullopt,
                        BelowHorizontal below = BelowHorizontal::sky);

/// Sky view factor A of a receiver that is present and sees `view`, if there is no sky below the horizontal.
double sky_above_horizontal(const ExactWalker& walker, int row, int column, const SliceView& view);

/// μ(d) of a maximum distance: the share by which an occluder at distance d (world units) leaves its
/// direction open.
double open_share(const MaximumDistance& maximum_distance, double distance);

}  // namespace heightlight
