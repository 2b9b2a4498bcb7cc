#pragma once

#include "visibility/field_pyramid.h"
#include "visibility/height_pyramid.h"
#include "visibility/walk_table.h"

namespace heightlight {

/// The heights that walks of one kind look at, with margins, so that receivers of the whole map read them
/// where they lie. Built once for all gathers.
struct HorizonScene {
  FieldPyramid heights;  ///< level 0: the samples; level l: blocks as rings see them, with their peak share
  FieldPyramid lifted;  ///< level 0 alone: each sample, and WalkTile::kLift of what the highest of it and its
                        ///< eight neighbours has above it
};

/// `options`: their samples per octave says how far walks look, their peak share what rings see.
HorizonScene build_horizon_scene(const Surface& surface, const HeightPyramid& pyramid,
                                 const WalkOptions& options);

/// Texels or blocks beyond a map's edges that walks read, whole vectors included.
int walk_margin(const WalkOptions& options);

}  // namespace heightlight
