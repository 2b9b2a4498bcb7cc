#pragma once

#include <string>

#include "files/image_file.h"

namespace heightlight {

/// Draws a line of text, 7 × `scale` pixels high, whose upper left corner is at (row, column). What goes over
/// the picture's edge is cut off; what is no printable ASCII becomes a question mark.
void draw_text(Image<Rgb8>& picture, int row, int column, const std::string& text, int scale,
               const Rgb8& colour);

/// How many pixels wide it is.
int text_width(const std::string& text, int scale);

}  // namespace heightlight
