#pragma once

#include <vector>

#include "files/image_file.h"
#include "heightlight/surface.h"

namespace heightlight {

/// What a sphere wears: maps of one size, in the axes of the picture (x right, y up, z out of it).
struct SphereSkin {
  Map normal_x;
  Map normal_y;
  Map normal_z;
  Map occlusion;               ///< A
  std::vector<Map> reflected;  ///< albedo × E/π of all bounces: grey, or red, green and blue
  double proportion = 1;       ///< extent of the rows over that of the columns
};

/// A sphere on a ground of that colour, `side` pixels wide and high. The skin repeats twice from side to
/// side. It is lit plainly: by an even sky, of which each place gets what all bounces leave of it, and by a
/// lamp from the upper left, which reaches a place as far as it is open, by the cosine at its own normal.
Image<Rgb8> lit_sphere(const SphereSkin& skin, int side, const Rgb8& ground);

}  // namespace heightlight
