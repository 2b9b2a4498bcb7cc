#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/visibility.h"
#include "surface/maximum_pyramid.h"
#include "visibility/profile_walk.h"
#include "visibility/ray_traversal.h"

// The readable double-precision reference for everything that is computed from horizons. Each azimuth's
// profile is walked breakpoint by breakpoint (profile_walk.h), and every visible stretch is integrated in
// closed form (slice_integrals.h). Two errors remain: there are only few azimuths, and under `tile` what lies
// beyond kMostWraps tiles is left out.
//
// Azimuths are the world angles φ_k = 2π (k + ¼)/K, counterclockwise from x. The quarter matters: materials
// are full of features that are symmetric about an axis. With 0 or ½ instead, azimuths would see each such
// feature twice. With ¼ the mirrored azimuths lie halfway between the others, so that K azimuths do the work
// of 2K there.
//
// The slices' cosine-weighted masses sum to π only as K grows. Dividing by their sum makes the sky and the
// links of a receiver sum to 1 whatever its tilt. Solid angles are divided by their sum, too, instead of by
// 2π.

namespace heightlight {

/// The form factor of a visible stretch and the place that stands for it. The place is the weighted mean of
/// the stretch (mean_share), so that what is linear over a facet is gathered correctly. (The stretch's middle
/// would lie too high on a wall near by: among bricks this makes an error of 10⁻³ in what is gathered.)
struct VisibleInterval {
  double weight = 0;  ///< form factor; the sky view factor and all weights of a receiver sum to 1
  SurfacePoint place;
};

/// What one receiver sees in all azimuths. Where the sample is missing, all vectors are empty and the other
/// values are NaN.
struct SliceView {
  double ambient_occlusion = 1;                            ///< α: the sky's share of the solid angle
  double sky_view_factor = 1;                              ///< A: the sky's form factor
  Eigen::Vector3d bent_normal = Eigen::Vector3d::UnitZ();  ///< unit vector, cosine weighted; world axes
  /// Per azimuth: elevation of the profile's steepest point, in the map's axes. It may be below the tangent
  /// plane; −π/2 where there is no surface.
  std::vector<double> horizon_rad;
  std::vector<VisibleInterval> links;  ///< by azimuth, and from below upwards within each azimuth
  std::vector<std::size_t> links_end;  ///< per azimuth: index behind its last link
};

/// Estimated bytes of what a receiver sees along `azimuths` azimuths. A profile over n texels has about 2 √n
/// visible stretches where the ground is fractal, and fewer elsewhere.
std::uint64_t slice_view_bytes(int width, int height, int azimuths);

/// How far an exact walk goes, in world units: the maximum distance, here measured horizontally, or infinity
/// where there is none.
inline double exact_maximum_distance(const std::optional<MaximumDistance>& maximum_distance) {
  return maximum_distance ? maximum_distance->distance : std::numeric_limits<double>::infinity();
}

/// Walks from the vertices of a surface. Holds what all receivers share; the surface must outlive it.
class ExactWalker {
 public:
  /// `azimuths` ≥ 1; `maximum_distance` > 0: what is farther away (world units, horizontally) does not count.
  ExactWalker(const Surface& surface, int azimuths,
              double maximum_distance = std::numeric_limits<double>::infinity());
  /// For ground that is not in memory. `header` has what the surface has except samples and normals, which
  /// `ground` gives. `bounds` is the ground's maximum pyramid, which has no level below `first_level`.
  ExactWalker(const Surface& header, int azimuths, const StoredGround& ground, MaximumPyramid bounds,
              int first_level);
  ExactWalker(const ExactWalker&) = delete;  // its grid refers to its pyramid
  ExactWalker& operator=(const ExactWalker&) = delete;

  int azimuths() const { return azimuths_; }

  /// φ_k of the k-th azimuth, rad.
  double azimuth_rad(int k) const;

  /// What the receiver at (row, column) sees. Safe to call from many threads with a view each.
  void view(int row, int column, SliceView& view) const;

  /// Elevation of the horizon (rad) in any one azimuth, counterclockwise from x; as SliceView::horizon_rad.
  /// NaN where the sample is missing.
  double horizon_rad(int row, int column, double azimuth_rad) const;

  /// Walks from a receiver that is present along a horizontal unit vector. Returns the slope of the horizon
  /// (−∞ where there is no surface) and appends what is seen above `least_slope` to `stretches`.
  double walk(int row, int column, const Eigen::Vector2d& azimuth, double least_slope,
              std::vector<VisibleStretch>& stretches) const;

  /// The slope that `walk` returns, without the stretches.
  double horizon_slope(int row, int column, const Eigen::Vector2d& azimuth) const;

  /// Slope of what is level at the receiver, along a horizontal unit vector: 0, unless the map is curved.
  double level_slope(int row, int column, const Eigen::Vector2d& azimuth) const;

  /// The surface, or the header of ground that is not in memory. Read samples and normals by the functions
  /// below.
  const Surface& surface() const { return surface_; }
  float height(int row, int column) const {
    return ground_ ? ground_->height(row, column) : surface_.map.height(row, column);
  }
  Vector3 normal(int row, int column) const {
    return ground_ ? ground_->normal(row, column) : surface_.normal(row, column);
  }

 private:
  const Surface& surface_;
  const StoredGround* ground_ = nullptr;
  MaximumPyramid pyramid_;
  RayGrid grid_;
  int azimuths_;
  double maximum_distance_;
};

}  // namespace heightlight
