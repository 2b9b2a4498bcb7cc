#pragma once

#include "visibility/field_pyramid.h"
#include "visibility/height_pyramid.h"
#include "visibility/walk_table.h"

namespace heightlight {

/// The heights that walks of one kind read, with margins, so that receivers of the whole map read them
/// without copies. Built once for all gathers.
struct HorizonScene {
  FieldPyramid heights;  ///< level 0: the samples; level l: the heights of blocks as rings see them, which
                         ///< include their peak share
  FieldPyramid lifted;   ///< level 0 only: each sample, raised by WalkTile::kLift of what the highest of it
                         ///< and its eight neighbours has above it
};

/// Builds the scene. The samples per octave of `options` determine how far walks look, the peak share what
/// rings see.
HorizonScene build_horizon_scene(const Surface& surface, const HeightPyramid& pyramid,
                                 const WalkOptions& options);

/// Number of texels or blocks beyond a map's edges that walks read, including whole vectors.
int walk_margin(const WalkOptions& options);

}  // namespace heightlight
