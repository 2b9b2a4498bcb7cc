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

// The readable, double-precision reference for what horizons tell: each azimuth's profile is walked
// breakpoint by breakpoint (profile_walk.h), and every visible stretch is integrated in closed form
// (slice_integrals.h). The error is that of few azimuths, and under `tile` what lies beyond kMostWraps tiles.
//
// Azimuths are the world angles φ_k = 2π (k + ¼)/K, counterclockwise from x. The quarter matters: materials
// are full of features that an axis mirrors, for which 0 or ½ would make azimuths see everything twice. With
// ¼ the mirrored azimuths lie halfway between the others, so that K of them do the work of 2K there.
//
// The slices' cosine-weighted masses sum to π only as K grows; dividing by their sum makes the sky and the
// links of a receiver sum to 1 whatever its tilt. Likewise for the solid angle, 2π.

namespace heightlight {

/// A share of a receiver's cosine-weighted hemisphere and the place that stands for what it sees: the
/// weighted mean of the visible stretch (mean_share), so that what is linear over a facet is gathered
/// rightly. (The stretch's middle would lie too high on a wall near by: among bricks it errs by 10⁻³ in what
/// is gathered.)
struct VisibleInterval {
  double weight = 0;  ///< form factor; sky view factor + Σ weights = 1
  SurfacePoint place;
};

/// What one receiver sees in all azimuths. Where the sample is missing both vectors are empty and the rest is
/// NaN.
struct SliceView {
  double ambient_occlusion = 1;                            ///< α: of the solid angle
  double sky_view_factor = 1;                              ///< A: of the form factor
  Eigen::Vector3d bent_normal = Eigen::Vector3d::UnitZ();  ///< unit, cosine weighted; world axes
  std::vector<double> horizon_rad;  ///< per azimuth, in the map's axes: elevation of the profile's steepest
                                    ///< point, which may be
                                    ///< below the tangent plane; −π/2 where there is no surface
  std::vector<VisibleInterval> links;  ///< by azimuth, each from below upwards
  std::vector<std::size_t> links_end;  ///< of each azimuth: behind its last link
};

/// Bytes of what a receiver sees along so many azimuths. A profile over n texels has about 2 √n stretches in
/// view where the ground is fractal, and fewer elsewhere.
std::uint64_t slice_view_bytes(int width, int height, int azimuths);

/// How far an exact walk goes for a maximum distance, which is taken to lie on the map.
inline double exact_maximum_distance(const std::optional<MaximumDistance>& maximum_distance) {
  return maximum_distance ? maximum_distance->distance : std::numeric_limits<double>::infinity();
}

/// Walks from the vertices of a surface. Holds what all receivers share; the surface must outlive it.
class ExactWalker {
 public:
  /// `azimuths` ≥ 1; `maximum_distance` > 0: nothing farther away (world units, horizontally) counts.
  ExactWalker(const Surface& surface, int azimuths,
              double maximum_distance = std::numeric_limits<double>::infinity());
  /// On ground that is not in memory, within bounds of which there is no level below `first_level`. `header`
  /// has what the surface has, but for samples and normals.
  ExactWalker(const Surface& header, int azimuths, const StoredGround& ground, MaximumPyramid bounds,
              int first_level);
  ExactWalker(const ExactWalker&) = delete;  // its grid refers to its pyramid
  ExactWalker& operator=(const ExactWalker&) = delete;

  int azimuths() const { return azimuths_; }

  /// φ_k of the k-th azimuth.
  double azimuth_rad(int k) const;

  /// What the receiver at (row, column) sees. Safe to call from many threads with a view each.
  void view(int row, int column, SliceView& view) const;

  /// Elevation of the horizon in any one azimuth, counterclockwise from x; as SliceView::horizon_rad. NaN
  /// where the sample is missing.
  double horizon_rad(int row, int column, double azimuth_rad) const;

  /// Slope of the horizon along a horizontal unit vector (−∞ where there is no surface), of a receiver that
  /// is present; appends what is seen above `least_slope`.
  double walk(int row, int column, const Eigen::Vector2d& azimuth, double least_slope,
              std::vector<VisibleStretch>& stretches) const;

  /// That slope alone.
  double horizon_slope(int row, int column, const Eigen::Vector2d& azimuth) const;

  /// Slope of what is level at the receiver, likewise: 0, unless the map is curved.
  double level_slope(int row, int column, const Eigen::Vector2d& azimuth) const;

  /// Its samples and normals may be elsewhere: below.
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
