#include "plot/panel_grid.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include "plot/gnuplot_run.h"

namespace heightlight {
namespace {

// What axes and titles take of a panel, in pixels.
constexpr int kLeft = 75;
constexpr int kRight = 12;
constexpr int kBottom = 62;

int total_width(const PanelGrid& grid) { return grid.width * static_cast<int>(grid.columns) + grid.key; }
int total_height(const PanelGrid& grid) { return grid.height * static_cast<int>(grid.rows()) + grid.head; }

/// Edges of the axes, in pixels from the lower left corner.
void set_margins(gnuplotio::Gnuplot& script, const PanelGrid& grid, int left, int right, int bottom,
                 int top) {
  script << fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n",
                        1.0 * left / total_width(grid), 1.0 * right / total_width(grid))
         << fmt::format("set bmargin at screen {:.5f}\nset tmargin at screen {:.5f}\n",
                        1.0 * bottom / total_height(grid), 1.0 * top / total_height(grid));
}

}  // namespace

std::string terminal_of(const PanelGrid& grid, bool is_svg) {
  return fmt::format("{} size {},{} font '{}' background 'white'", is_svg ? "svg" : "pngcairo",
                     total_width(grid), total_height(grid), is_svg ? "sans-serif,14" : "sans,11");
}

void begin_grid(gnuplotio::Gnuplot& script, const PanelGrid& grid, const std::string& title) {
  script << "set multiplot title " << gnuplot_quoted(title)
         << fmt::format(" font ':Bold,{}' noenhanced\n", grid.head > 0 ? 15 : 1);
}

void place_panel(gnuplotio::Gnuplot& script, const PanelGrid& grid, std::size_t panel) {
  const int row = static_cast<int>(panel / grid.columns);
  const int column = static_cast<int>(panel % grid.columns);
  const int bottom = total_height(grid) - grid.head - (row + 1) * grid.height;
  set_margins(script, grid, column * grid.width + kLeft, (column + 1) * grid.width - kRight, bottom + kBottom,
              bottom + grid.height - grid.title);
  script << "unset key\n";
}

void draw_key(gnuplotio::Gnuplot& script, const PanelGrid& grid, const std::string& entries) {
  const int left = total_width(grid) - grid.key;
  set_margins(script, grid, left, total_width(grid), 0, total_height(grid) - grid.head);
  script << "unset logscale\nunset border\nunset tics\nunset grid\nunset title\nunset xlabel\nunset ylabel\n"
            "unset label\nset xrange [0:1]\nset yrange [0:1]\n"
         << fmt::format(
                "set key at screen {:.5f}, screen {:.5f} left top Left reverse samplen 2 spacing 1.2 "
                "noenhanced\n",
                (left + 6.0) / total_width(grid), 1 - (grid.head + 34.0) / total_height(grid))
         << "plot 2 notitle, " << entries << '\n';
}

}  // namespace heightlight
