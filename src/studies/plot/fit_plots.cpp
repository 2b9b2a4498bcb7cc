#include "plot/fit_plots.h"

#include <gnuplot-iostream.h>

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

#include "files/output_file.h"
#include "plot/gnuplot_run.h"

namespace heightlight {
namespace {

using gnuplotio::Gnuplot;

// Axes are fixed, so that gnuplot never has to find a range among no points.
constexpr const char* kFitStyle = R"(
set palette defined (0 '#440154', 1 '#46327e', 2 '#365c8d', 3 '#277f8e', 4 '#1fa187', 5 '#4ac16d', 6 '#a0da39')
set cbrange [0:1]
unset colorbox
set key samplen 2.2 spacing 1.15
)";

constexpr int kShownAlbedos = 11;

/// Rows and columns for a number of panels, no wider than three.
std::string layout(std::size_t panels) {
  const std::size_t columns = std::min<std::size_t>(3, std::max<std::size_t>(1, panels));
  return std::to_string((panels + columns - 1) / columns) + "," + std::to_string(columns);
}

std::string picture_size(std::size_t panels, bool is_svg) {
  const std::size_t columns = std::min<std::size_t>(3, std::max<std::size_t>(1, panels));
  const std::size_t rows = (panels + columns - 1) / columns;
  return std::string(is_svg ? "svg" : "pngcairo") + " size " + std::to_string(480 * columns) + "," +
         std::to_string(430 * rows) + " font '" + (is_svg ? "sans-serif,15" : "sans,12") +
         "' background 'white'";
}

/// AO, then the RMS error per judged albedo; NaN in bins without texels.
PlotTable error_table(const JudgedForm& form) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t columns = form.errors_by_ao.size() + 1;
  // gnuplot complains of tables without a valid point: the first is outside the axes, tied to no other
  PlotTable table{std::vector<double>(columns, -1), std::vector<double>(columns, kNan)};
  for (std::size_t bin = 0; bin < kErrorBins; ++bin) {
    std::vector<double> row{(static_cast<double>(bin) + 0.5) / kErrorBins};
    for (const auto& by_ao : form.errors_by_ao)
      row.push_back(by_ao[bin].weight > 0 ? by_ao[bin].rms() : kNan);
    table.push_back(row);
  }
  return table;
}

/// A gnuplot string of two lines; names of forms need no escapes.
std::string error_title(const JudgedForm& form) {
  std::ostringstream title;
  title << '"' << form.name << "\\nRMS" << std::fixed << std::setprecision(3);
  for (const std::size_t albedo : {0, 2, 4, 6, 8}) title << ' ' << form.errors[albedo].rms();
  title << '"';
  return title.str();
}

const char* axis_name(AoKind kind) {
  return kind == AoKind::ambient_occlusion ? "ambient occlusion α" : "sky view factor A";
}

void send_coefficient_panel(Gnuplot& script, const char* name, int column, double three_slope,
                            double three_offset, double all_slope, double all_offset, double published_slope,
                            double published_offset) {
  script << "set title '{/:Bold " << name << "(ρ)}'\n"
         << "plot $three using 1:" << column
         << " with points pt 7 ps 1 lc rgb '#0072B2' title 'three bounces', " << three_slope << "*x+("
         << three_offset << ") lw 1.6 lc rgb '#0072B2' notitle, $all using 1:" << column
         << " with points pt 5 ps 1 lc rgb '#D55E00' title 'all bounces', " << all_slope << "*x+("
         << all_offset << ") lw 1.6 lc rgb '#D55E00' notitle, " << published_slope << "*x+("
         << published_offset << ") lw 2 dt 2 lc rgb 'black' title 'published, eq. 33'\n";
}

PlotTable coefficient_table(const std::vector<AlbedoCubic>& cubics) {
  PlotTable table;
  for (const AlbedoCubic& cubic : cubics) table.push_back({cubic.albedo, cubic.a, cubic.b, cubic.c});
  return table;
}

}  // namespace

GnuplotResult draw_fitted(const std::string& terminal, const std::vector<FittedPanel>& panels) {
  return run_gnuplot([&](Gnuplot& script) {
    script << "set terminal " << terminal << '\n' << kShareAxisStyle << kFitStyle << "set yrange [0:1.05]\n";
    for (std::size_t i = 0; i < panels.size(); ++i) {
      send_table(script, "measured" + std::to_string(i), panels[i].measured);
      send_table(script, "fitted" + std::to_string(i), panels[i].fitted);
    }
    script << "set multiplot layout " << layout(panels.size()) << '\n';
    for (std::size_t i = 0; i < panels.size(); ++i) {
      script << "set title " << gnuplot_quoted(panels[i].title) << " noenhanced\nset xlabel '"
             << axis_name(panels[i].kind)
             << "'\nset ylabel 'E / π, ρ = 0 … 1'\nset key bottom right\nplot for [k=2:" << kShownAlbedos + 1
             << "] $fitted" << i
             << " using 1:(column(k)) with lines lw 3 lc palette cb (k-2)/10.0 notitle, for [k=2:"
             << kShownAlbedos + 1 << "] $measured" << i
             << " using 1:(column(k)) with lines lw 1 lc rgb '#D5200E' notitle, -1 with lines lw 1 lc rgb "
                "'#D5200E' title 'measured', -1 with lines lw 3 lc rgb '#277f8e' title 'form'\n";
    }
    script << "unset multiplot\n";
  });
}

GnuplotResult draw_errors(const std::string& terminal, const std::vector<JudgedForm>& forms) {
  return run_gnuplot([&](Gnuplot& script) {
    script << "set terminal " << terminal << '\n'
           << kShareAxisStyle << kFitStyle << "set yrange [0:0.3]\nset cbrange [0:8]\n";
    for (std::size_t i = 0; i < forms.size(); ++i) {
      send_table(script, "errors" + std::to_string(i), error_table(forms[i]));
    }
    script << "set multiplot layout " << layout(forms.size()) << '\n';
    for (std::size_t i = 0; i < forms.size(); ++i) {
      script << "set title " << error_title(forms[i]) << " noenhanced\nset xlabel '"
             << axis_name(forms[i].kind)
             << "'\nset ylabel 'RMS error of E / π'\nset key top right\nplot for [k=0:8:2] $errors" << i
             << " using 1:(column(k+2)) with lines lw 2.2 lc palette cb k title sprintf('ρ = 0.%d', k+1)\n";
    }
    script << "unset multiplot\n";
  });
}

GnuplotResult draw_cubics(const std::string& terminal, const CubicPanel& cubics) {
  return run_gnuplot([&](Gnuplot& script) {
    script << "set terminal " << terminal << '\n' << kShareAxisStyle << kFitStyle << std::setprecision(8);
    send_table(script, "three", coefficient_table(cubics.three_bounces));
    send_table(script, "all", coefficient_table(cubics.all_bounces));
    script << "set multiplot layout 1,3\nset xlabel 'albedo ρ'\nset yrange [*:*]\nset key top left\n";
    const CubicConstants& three = cubics.three_bounces_line;
    const CubicConstants& all = cubics.all_bounces_line;
    const CubicConstants published;
    send_coefficient_panel(script, "a", 2, three.a_slope, three.a_offset, all.a_slope, all.a_offset,
                           published.a_slope, published.a_offset);
    send_coefficient_panel(script, "b", 3, three.b_slope, three.b_offset, all.b_slope, all.b_offset,
                           published.b_slope, published.b_offset);
    send_coefficient_panel(script, "c", 4, three.c_slope, three.c_offset, all.c_slope, all.c_offset,
                           published.c_slope, published.c_offset);
    script << "unset multiplot\n";
  });
}

void plot_fitted(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<FittedPanel>& panels) {
  write_bytes(svg, draw_fitted(picture_size(panels.size(), true), panels).output);
  write_bytes(png, draw_fitted(picture_size(panels.size(), false), panels).output);
}

void plot_errors(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<JudgedForm>& forms) {
  write_bytes(svg, draw_errors(picture_size(forms.size(), true), forms).output);
  write_bytes(png, draw_errors(picture_size(forms.size(), false), forms).output);
}

void plot_cubics(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const CubicPanel& cubics) {
  write_bytes(svg, draw_cubics(picture_size(3, true), cubics).output);
  write_bytes(png, draw_cubics(picture_size(3, false), cubics).output);
}

}  // namespace heightlight
