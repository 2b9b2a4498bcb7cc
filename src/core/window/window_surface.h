#pragma once

#include "heightlight/surface.h"
#include "heightlight/visibility.h"
#include "visibility/field_pyramid.h"
#include "window/coarse_levels.h"

// A window of a map too large to be held: a surface whose receivers see all of the map, by what its
// Surroundings hold of it. What they see is what they see in the whole map, to the last bit: every level's
// blocks are the same.

namespace heightlight {

/// A map by parts: its samples where they are stored, what all of them have in common, and its coarse levels.
struct MapParts {
  const StoredMap& heights;  ///< above the base, NaN where missing
  double base = 0;
  Spacing spacing = {};
  Boundary boundary = Boundary::open;
  double curvature = 0;  ///< of the heights, about the map's middle
  float lowest = 0;
  float highest = 0;
  const CoarseHeights& coarse;
};

/// How far a window is to look: walk_margin of all its walks, and one more than their rings.
struct WindowView {
  int margin = 0;
  int levels = 0;
};

/// That of walks with these options, on the map.
WindowView window_view(const MapParts& map, const WalkOptions& options);

/// A map that tiles has sides that the blocks of its finest coarse level divide.
Surface window_surface(const MapParts& map, const WindowPlace& place, const WindowView& view);

/// A field on the map, NaN where missing, as gathers from the window read it: `layout` is a pyramid made for
/// the window's surface.
void fill_window_field(const Surface& window, const StoredMap& field, const CoarseField& coarse,
                       FieldPyramid& layout);

}  // namespace heightlight
