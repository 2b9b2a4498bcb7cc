#pragma once

#include <array>

#include "visibility/walk_tile.h"

// What receivers see from afar, found for groups of receivers.
//
// A thing at height v and world distance d is seen from height z under the slope (v − z)/d. For receivers at
// one place but of any height z, this slope is a straight line in z. The horizon is the upper envelope of
// such lines and convex in z. Over the small span of heights in a group, few lines are ever highest. A group
// of receivers therefore looks only once, from the texel in its middle. It keeps the line that is highest for
// its lowest, its middle and its highest height. (This is exact where one line is highest at both ends of the
// span, and otherwise a little too low.) Each receiver of the group then has three lines to evaluate.
//
// Groups of 4 × 4 receivers look at ring 1. Groups of 8 × 8 look at the rings from 2 on and hand their lines
// down to the groups in them. A place δ further along the azimuth than the texel in the middle is nearer to
// the thing: 1/(d − δ) ≈ (1 + δ/d)/d.

namespace heightlight {

/// The first rings that groups and wide groups look at.
constexpr int kGroupRing = 1;
constexpr int kWideGroupRing = 2;

/// Lines kept per group: the slope (height − z) × per_distance. An absent line has the height kNoHeight and
/// the distance 1 / kNowhere: it lies below any slope, and so far away that no receiver's place changes that.
constexpr float kNowhere = 1e-12F;

struct FarView {
  static constexpr int kLines = 3;
  static constexpr int kGroups = (WalkTile::kSide / WalkTile::kGroup) * (WalkTile::kSide / WalkTile::kGroup);

  // Padded, because whole vectors are read where only a part is wanted.
  alignas(64) std::array<std::array<float, kGroups + kReadPadding>, kLines> height{};
  alignas(64) std::array<std::array<float, kGroups + kReadPadding>, kLines> per_distance{};
};

/// Looks at all rings of an azimuth from all groups of the tile. The readable implementation.
void look_far_scalar(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view);

/// The fast implementation, with groups side by side. Heights are the same; distances differ by the rounding
/// of fused products.
void look_far(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view);

}  // namespace heightlight
