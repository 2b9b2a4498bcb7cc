#pragma once

#include "heightlight/heightmap.h"
#include "visibility/ray_traversal.h"
#include "window/paged_map.h"

namespace heightlight {

/// Ground for exact walks over a map that is not in memory.
class PagedGround : public StoredGround {
 public:
  /// All arguments must outlive it. `bytes` as PagedMap has them.
  PagedGround(const StoredMap& heights, Spacing spacing, Boundary boundary, std::uint64_t bytes);

  float height(int row, int column) const override { return paged_.at(row, column); }
  Vector3 normal(int row, int column) const override;

 private:
  const StoredMap& heights_;
  Spacing spacing_;
  Boundary boundary_;
  PagedMap paged_;
};

}  // namespace heightlight
