#include "plot/error_pictures.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "files/output_file.h"
#include "plot/gnuplot_run.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

/// Blue, white, red, even in lightness on both sides (after ColorBrewer's RdBu), from −1 to 1.
constexpr std::array<std::array<double, 3>, 7> kDiverging{{{33, 102, 172},
                                                           {103, 169, 207},
                                                           {209, 229, 240},
                                                           {255, 255, 255},
                                                           {253, 219, 199},
                                                           {239, 138, 98},
                                                           {178, 24, 43}}};

Rgb8 diverging_colour(double share) {
  const double at = (std::clamp(share, -1.0, 1.0) + 1) / 2 * (kDiverging.size() - 1);
  const auto first = std::min(static_cast<std::size_t>(at), kDiverging.size() - 2);
  const double part = at - static_cast<double>(first);
  Rgb8 colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = (1 - part) * kDiverging[first][c] + part * kDiverging[first + 1][c];
    colour[c] = static_cast<std::uint8_t>(std::lround(value));
  }
  return colour;
}

void send_matrix(gnuplotio::Gnuplot& script, const std::string& name, const Map& map) {
  script << '$' << name << " << e\n";
  for (int row = 0; row < map.height; ++row) {
    for (int column = 0; column < map.width; ++column) {
      script << fmt::format("{:.4f} ", map(row, column));
    }
    script << '\n';
  }
  script << "e\n";
}

void send_palette(gnuplotio::Gnuplot& script) {
  script << "set palette defined (";
  for (std::size_t i = 0; i < kDiverging.size(); ++i) {
    const auto level = [i](std::size_t channel) { return static_cast<unsigned>(kDiverging[i][channel]); };
    script << fmt::format("{}{} '#{:02x}{:02x}{:02x}'", i > 0 ? ", " : "", i, level(0), level(1), level(2));
  }
  script << ")\n";
}

}  // namespace

Image<Rgb8> difference_picture(const Map& differences) {
  Image<Rgb8> picture(differences.width, differences.height, kMissingColour);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const double difference = static_cast<double>(differences.values[i]);
    if (!std::isnan(difference)) picture.values[i] = diverging_colour(difference / kFullDifference);
  }
  return picture;
}

void plot_error_sheet(const std::filesystem::path& png, const std::vector<ErrorMap>& maps,
                      const ErrorSheet& sheet) {
  constexpr int kWidestPanel = 330;
  constexpr int kNarrowestPanel = 190;
  constexpr int kSheetWidth = 1400;
  constexpr int kHead = 40;
  constexpr int kFoot = 80;
  const int columns = std::min(sheet.columns, std::max(1, static_cast<int>(maps.size())));
  const int rows = std::max(1, (static_cast<int>(maps.size()) + columns - 1) / columns);
  const int panel_width = std::min(kWidestPanel, std::max(kNarrowestPanel, kSheetWidth / columns));
  const int panel_height = panel_width + 55;  // with its title
  const double height = panel_height * rows + kHead + kFoot;
  const GnuplotResult result = run_gnuplot([&](gnuplotio::Gnuplot& script) {
    script << "set terminal pngcairo size " << panel_width * columns << ',' << height
           << " font 'sans,10' background 'white'\n";
    for (std::size_t i = 0; i < maps.size(); ++i) {
      if (maps[i].differences.size() == 0) continue;
      send_matrix(script, "map" + std::to_string(i), thin_out(maps[i].differences));
    }
    send_palette(script);
    script << "set encoding utf8\nset multiplot title " << gnuplot_quoted(sheet.title)
           << " font ':Bold,14' noenhanced\n"
           << "set cbrange [" << -kFullDifference << ':' << kFullDifference << "]\n"
           << "unset key\nunset tics\nset cbtics\nset border lw 0.6 lc rgb '#444444'\nset size ratio -1\n"
           << "set colorbox horizontal user origin 0.3," << 50 / height << " size 0.4," << 18 / height
           << "\nset cblabel " << gnuplot_quoted(sheet.quantity) << " noenhanced\n";
    for (std::size_t i = 0; i < maps.size(); ++i) {
      if (maps[i].differences.size() == 0) continue;
      const int row = static_cast<int>(i) / columns;
      const int column = static_cast<int>(i) % columns;
      const double top = kFoot + panel_height * (rows - row);  // pixels from below
      const Map thin = thin_out(maps[i].differences);
      const std::string rmse =
          fmt::format("RMSE {:.4f}, bias {:+.4f}", maps[i].error.rmse, maps[i].error.bias);
      script << "set lmargin at screen " << (column + 0.03) / columns << "\nset rmargin at screen "
             << (column + 0.97) / columns << "\nset tmargin at screen " << (top - 65) / height
             << "\nset bmargin at screen " << (top - panel_height + 8) / height << "\nset title "
             << gnuplot_quoted(maps[i].title) << ".\"\\n\"." << gnuplot_quoted(maps[i].subtitle) << ".\"\\n"
             << rmse << "\" noenhanced offset 0,-0.6 font ',8'\n"
             << "set xrange [-0.5:" << thin.width - 0.5 << "]\nset yrange [" << thin.height - 0.5
             << ":-0.5]\n"
             << "plot $map" << i << " matrix with image\nunset colorbox\n";
    }
    if (maps.empty()) script << "set xrange [0:1]\nset yrange [0:1]\nplot NaN\n";
    script << "unset multiplot\n";
  });
  write_bytes(png, result.output);
}

}  // namespace heightlight
