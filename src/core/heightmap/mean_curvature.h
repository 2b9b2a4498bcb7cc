#pragma once

#include "heightlight/heightmap.h"

namespace heightlight {

/// Mean curvature of the graph of a height field, in 1/world length, positive where it is convex: 1/R on a
/// sphere of radius R seen from outside, 1/(2R) on a cylinder, −1/R in a bowl. From central differences, of
/// second order in the spacing:
///     −((1 + h_y²) h_xx − 2 h_x h_y h_xy + (1 + h_x²) h_yy) / (2 (1 + h_x² + h_y²)^(3/2))
/// (do Carmo, Differential Geometry of Curves and Surfaces, 3.3). A map that tiles is wrapped. Beyond open
/// edges and at holes the surface is continued in a straight line. NaN where the sample is missing.
Map mean_curvature(const Image<double>& height, const Spacing& spacing, Boundary boundary);

}  // namespace heightlight
