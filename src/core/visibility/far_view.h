#pragma once

#include <array>

#include "visibility/walk_tile.h"

// What receivers see from afar, found for groups of them.
//
// A thing at height v and world distance d stands under the slope (v − z)/d: seen from receivers of one place
// but any height z, a straight line in z. The horizon is the upper envelope of such lines, convex in z, and
// over the small span of heights in a group few of them ever lead. A group of receivers therefore looks once,
// from the texel in its middle, and keeps the line that leads for its lowest, its middle and its highest
// height. (That is exact where one line leads at both ends, and else a little low.) Its receivers then have
// three things to look at.
//
// Ring 1 is looked at by groups of 4 × 4, rings from 2 on by groups of 8 × 8, which hand their lines down. A
// place δ further along the azimuth than the look-out is nearer to the thing: 1/(d − δ) ≈ (1 + δ/d)/d.

namespace heightlight {

/// The first rings that groups and wide groups look at.
constexpr int kGroupRing = 1;
constexpr int kWideGroupRing = 2;

/// Lines kept per group: (height − z) × per_distance. Absent ones have the height kNoHeight, at 1 / kNowhere:
/// below any slope, and so far that no receiver's place changes that.
constexpr float kNowhere = 1e-12F;

struct FarView {
  static constexpr int kLines = 3;
  static constexpr int kGroups = (WalkTile::kSide / WalkTile::kGroup) * (WalkTile::kSide / WalkTile::kGroup);

  // Padded, since vectors are read whole where a part is wanted.
  alignas(64) std::array<std::array<float, kGroups + kReadPadding>, kLines> height{};
  alignas(64) std::array<std::array<float, kGroups + kReadPadding>, kLines> per_distance{};
};

/// The readable one.
void look_far_scalar(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view);

/// The fast one: groups side by side. Heights are the same, distances but for the rounding of fused products.
void look_far(const WalkTile& tile, const AzimuthTable& azimuth, FarView& view);

}  // namespace heightlight
