// stb's letters, for this file alone; their names are not visible to a program that links this library.
#include "files/picture_text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#include <stb/stb_easy_font.h>
#pragma GCC diagnostic pop

namespace heightlight {
namespace {

/// The vertex that stb writes for each corner of a rectangle.
struct Corner {
  float x;
  float y;
  float z;
  std::array<std::uint8_t, 4> colour;
};

std::string printable_ascii(std::string text) {
  for (char& letter : text) {
    if (letter < ' ' || letter > '~') letter = '?';
  }
  return text;
}

void fill(Image<Rgb8>& picture, const std::array<int, 4>& rectangle, const Rgb8& colour) {
  const auto [top, left, bottom, right] = rectangle;
  for (int row = std::max(top, 0); row < std::min(bottom, picture.height); ++row) {
    for (int column = std::max(left, 0); column < std::min(right, picture.width); ++column)
      picture(row, column) = colour;
  }
}

}  // namespace

void draw_text(Image<Rgb8>& picture, int row, int column, const std::string& text, int scale,
               const Rgb8& colour) {
  constexpr std::size_t kCornersOfLetter = 128;
  std::string letters = printable_ascii(text);
  std::vector<Corner> corners(kCornersOfLetter * (letters.size() + 1));
  const int rectangles = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(),
                                             static_cast<int>(corners.size() * sizeof(Corner)));
  const auto place = [scale](int origin, float at) { return origin + static_cast<int>(at) * scale; };
  for (int i = 0; i < rectangles; ++i) {
    const Corner& first = corners[4 * static_cast<std::size_t>(i)];
    const Corner& last = corners[4 * static_cast<std::size_t>(i) + 2];
    fill(picture, {place(row, first.y), place(column, first.x), place(row, last.y), place(column, last.x)},
         colour);
  }
}

int text_width(const std::string& text, int scale) {
  std::string letters = printable_ascii(text);
  return stb_easy_font_width(letters.data()) * scale;
}

}  // namespace heightlight
