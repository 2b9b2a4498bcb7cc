#pragma once

#include <cstddef>
#include <string>

namespace gnuplotio {
class Gnuplot;
}

namespace heightlight {

/// Panels in rows and columns under a title, and beside them on the right a strip for one key of all. Pixels.
struct PanelGrid {
  std::size_t panels = 1;
  std::size_t columns = 1;
  int width = 460;  ///< of a panel, its labels included
  int height = 410;
  int title = 36;  ///< height of its title
  int key = 230;   ///< width of the strip
  int head = 40;   ///< height of the title

  std::size_t rows() const { return (panels + columns - 1) / columns; }
};

/// "svg size 1610,840 …" or pngcairo's, for `set terminal`.
std::string terminal_of(const PanelGrid& grid, bool is_svg);

/// `set multiplot` with the title.
void begin_grid(gnuplotio::Gnuplot& script, const PanelGrid& grid, const std::string& title);

/// The next plot goes there, without a key.
void place_panel(gnuplotio::Gnuplot& script, const PanelGrid& grid, std::size_t panel);

/// Draws the key alone: `entries` is a list of gnuplot's `keyentry …`, with commas between.
void draw_key(gnuplotio::Gnuplot& script, const PanelGrid& grid, const std::string& entries);

}  // namespace heightlight
