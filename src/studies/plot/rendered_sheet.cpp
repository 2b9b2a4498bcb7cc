#include "plot/rendered_sheet.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include <algorithm>

#include "files/output_file.h"
#include "plot/gnuplot_run.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

/// Column, row, red, green, blue of every pixel.
void send_pixels(gnuplotio::Gnuplot& script, std::size_t number, const std::array<Map, 3>& channels) {
  script << "$pixels" << number << " << e\n";
  for (int row = 0; row < channels[0].height; ++row) {
    for (int column = 0; column < channels[0].width; ++column)
      script << fmt::format("{} {} {} {} {}\n", column, row, encode_srgb(channels[0](row, column)),
                            encode_srgb(channels[1](row, column)), encode_srgb(channels[2](row, column)));
  }
  script << "e\n";
}

}  // namespace

void plot_rendered(const std::filesystem::path& png, const std::vector<RenderedForm>& rendered,
                   const RenderedSheet& sheet) {
  constexpr int kSheetWidth = 1760;
  const int width = std::min(330, kSheetWidth / static_cast<int>(std::max<std::size_t>(1, sheet.columns)));
  const int height = width + 58;
  const std::size_t rows = (rendered.size() + sheet.columns - 1) / sheet.columns;
  const double total_width = static_cast<double>(width) * static_cast<double>(sheet.columns);
  const double total_height = static_cast<double>(height) * static_cast<double>(rows) + 40;
  const GnuplotResult result = run_gnuplot([&](gnuplotio::Gnuplot& script) {
    script << fmt::format("set terminal pngcairo size {:.0f},{:.0f} font 'sans,10' background 'white'\n",
                          total_width, total_height)
           << "set encoding utf8\nset multiplot title " << gnuplot_quoted(sheet.title)
           << " font ':Bold,14' noenhanced\nunset key\nunset tics\nset border lw 0.6 lc rgb '#444444'\n";
    for (std::size_t i = 0; i < rendered.size(); ++i) {
      const Map& first = rendered[i].reflected[0];
      if (first.size() == 0) continue;
      send_pixels(script, i, rendered[i].reflected);
      const std::size_t row = i / sheet.columns;
      const double left = static_cast<double>(width) * static_cast<double>(i % sheet.columns);
      const double top = total_height - 40 - static_cast<double>(height) * static_cast<double>(row);
      const std::string error = rendered[i].rmse > 0
                                    ? fmt::format("RMSE of {} {:.4f}", sheet.quantity, rendered[i].rmse)
                                    : std::string();
      script
          << fmt::format(
                 "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset tmargin at screen "
                 "{:.5f}\nset "
                 "bmargin at screen {:.5f}\n",
                 (left + 5) / total_width, (left + width - 5) / total_width, (top - 54) / total_height,
                 (top - height + 6) / total_height)
          << "set title " << gnuplot_quoted(rendered[i].title) << ".\"\\n\"."
          << gnuplot_quoted(rendered[i].label) << ".\"\\n"
          << error << "\" noenhanced offset 0,-0.6 font ',9'\n"
          << fmt::format(
                 "set xrange [-0.5:{}]\nset yrange [{}:-0.5]\nplot $pixels{} using 1:2:3:4:5 with rgbimage\n",
                 first.width - 0.5, first.height - 0.5, i);
    }
    script << "unset multiplot\n";
  });
  write_bytes(png, result.output);
}

}  // namespace heightlight
