#pragma once

#include <string>
#include <vector>

#include "files/image_file.h"
#include "heightlight/surface.h"
#include "heightlight/transport.h"

namespace heightlight {

/// A material whose maps were found, for a look at all of them. What is referred to must outlive it.
struct SheetMaterial {
  const Surface& surface;
  const Map& occlusion;                ///< A
  const Image<Vector3>& first_moment;  ///< along the bent normal
  const std::vector<Map>& totals;      ///< E/π of all bounces: one, or red, green and blue
  const Albedo& albedo;
  std::string name;     ///< of the map
  bool y_down = false;  ///< of the bent normals as they are shown
};

/// One picture with a lit sphere (lit_sphere.h), heights, occlusion, bent normals and bounces, all labelled:
/// what they are, the relief, the median slope and the mean occlusion. Maps are shown as their files are, not
/// encoded, and averaged where they are larger than their place. Takes 32 MiB and two maps of the surface's
/// size at most.
Image<Rgb8> draw_material_sheet(const SheetMaterial& material);

}  // namespace heightlight
