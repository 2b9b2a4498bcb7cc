#pragma once

#include <string>

#include "files/image_file.h"

namespace heightlight {

/// Draws a line of text, 7 × `scale` pixels high, whose upper left corner is at (row, column). Pixels beyond
/// the picture's edge are cut off; characters that are not printable ASCII become question marks.
void draw_text(Image<Rgb8>& picture, int row, int column, const std::string& text, int scale,
               const Rgb8& colour);

/// Width of the text in pixels.
int text_width(const std::string& text, int scale);

}  // namespace heightlight
