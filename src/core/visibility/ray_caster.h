#pragma once

#include <Eigen/Core>
#include <vector>

#include "heightlight/visibility.h"
#include "visibility/hemisphere_directions.h"
#include "visibility/ray_traversal.h"

namespace heightlight {

/// Buffers that one thread reuses from receiver to receiver.
struct RayWorkspace {
  explicit RayWorkspace(int rays);

  std::vector<float> step_u, step_v, slope, sky_way;
  std::vector<std::int32_t> cell;
  std::vector<float> across, down;
};

/// Sends rays from the vertices of a surface. Holds what all receivers share; the surface must outlive it.
class RayCaster {
 public:
  /// Throws UsageError unless 1 ≤ options.rays ≤ 65536.
  RayCaster(const Surface& surface, const RayOptions& options);
  RayCaster(const RayCaster&) = delete;  // its grid refers to its pyramid
  RayCaster& operator=(const RayCaster&) = delete;

  int rays() const { return directions_.count; }
  const HemisphereDirections& directions() const { return directions_; }

  /// What the receiver at (row, column) sees. Safe to call from many threads with a workspace each.
  void view(int row, int column, RayWorkspace& workspace, ReceiverView& view) const;

  /// The sky's share of `view` if there is no sky below the horizontal: rays that miss the surface and point
  /// below the horizontal count as hits.
  SkyShare share_above_horizontal(int row, int column, const ReceiverView& view,
                                  RayWorkspace& workspace) const;

  /// The grid rays of a receiver that is present, without the ways after which they are sure to reach the
  /// sky. This is what another ray tracer needs to send the same rays.
  RayBundle aim_directions(int row, int column, const LatticeTurn& turn, RayWorkspace& workspace) const;

  /// As aim_directions, but with `sky_way` set: ready for `traverse`.
  RayBundle aim(int row, int column, const LatticeTurn& turn, RayWorkspace& workspace) const;

  /// Sets open[k] to 1 where a receiver that is present sees the sky in directions[k], and to 0 where the
  /// surface hides it. Directions are unit vectors in world axes, at most rays() of them.
  void look_along(int row, int column, const std::vector<Eigen::Vector3f>& directions,
                  RayWorkspace& workspace, std::vector<char>& open) const;

  const RayGrid& grid() const { return grid_; }

 private:
  /// The bundle of the first `count` rays of the workspace.
  RayBundle bundle_of(int row, int column, int count, const RayWorkspace& workspace) const;
  void find_sky_ways_of(RayBundle& bundle, RayWorkspace& workspace) const;

  const Surface& surface_;
  MaximumPyramid pyramid_;
  RayGrid grid_;
  HemisphereDirections directions_;
};

}  // namespace heightlight
