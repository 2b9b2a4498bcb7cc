#include "plot/fit_plots.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <limits>
#include <sstream>

#include "files/output_file.h"
#include "plot/colours.h"
#include "plot/gnuplot_run.h"
#include "plot/panel_grid.h"

namespace heightlight {
namespace {

using gnuplotio::Gnuplot;

// Axes are fixed, so that gnuplot never has to find a range among no points.

constexpr std::size_t kShownAlbedos = 11;
constexpr const char* kMeasuredStyle = "lw 1.2 lc rgb '#D5200E'";

std::string albedo_style(std::size_t k, std::size_t count) {
  return fmt::format("lw 2.6 lc rgb '{}'",
                     ordered_colour(static_cast<double>(k) / static_cast<double>(count - 1)));
}

PanelGrid make_grid(std::size_t panels) {
  return {
      .panels = panels, .columns = std::min<std::size_t>(3, std::max<std::size_t>(1, panels)), .width = 430};
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

constexpr const char* kThreeColour = "#0072B2";
constexpr const char* kAllColour = "#D55E00";
constexpr const char* kPublishedCubicStyle = "lw 2 dt 2 lc rgb 'black'";

/// A straight line over the albedo.
struct CoefficientLine {
  double slope;
  double offset;
};

std::string line_plot(const CoefficientLine& line, const std::string& style) {
  return fmt::format(", {:.8g}*x+({:.8g}) {} notitle", line.slope, line.offset, style);
}

void send_coefficient_panel(Gnuplot& script, const char* name, int column,
                            const std::array<CoefficientLine, 3>& lines) {
  script << "set title '{/:Bold " << name << "(ρ)}'\n"
         << fmt::format("plot $three using 1:{} with points pt 7 ps 1.1 lc rgb '{}' notitle", column,
                        kThreeColour)
         << line_plot(lines[0], fmt::format("lw 1.6 lc rgb '{}'", kThreeColour))
         << fmt::format(", $all using 1:{} with points pt 5 ps 1.1 lc rgb '{}' notitle", column, kAllColour)
         << line_plot(lines[1], fmt::format("lw 1.6 lc rgb '{}'", kAllColour))
         << line_plot(lines[2], kPublishedCubicStyle) << '\n';
}

PlotTable coefficient_table(const std::vector<AlbedoCubic>& cubics) {
  PlotTable table;
  for (const AlbedoCubic& cubic : cubics) table.push_back({cubic.albedo, cubic.a, cubic.b, cubic.c});
  return table;
}

}  // namespace

GnuplotResult draw_fitted(bool is_svg, const std::vector<FittedPanel>& panels) {
  const PanelGrid grid = make_grid(panels.size());
  return run_gnuplot([&](Gnuplot& script) {
    script << "set terminal " << terminal_of(grid, is_svg) << '\n'
           << kShareAxisStyle << "set yrange [0:1.05]\n";
    for (std::size_t i = 0; i < panels.size(); ++i) {
      send_table(script, "measured" + std::to_string(i), panels[i].measured);
      send_table(script, "fitted" + std::to_string(i), panels[i].fitted);
    }
    begin_grid(script, grid, "Forms (thick) over measured bin means (red), ρ = 0 to 1");
    for (std::size_t i = 0; i < panels.size(); ++i) {
      place_panel(script, grid, i);
      script << "set title " << gnuplot_quoted(panels[i].title) << " font ':Bold' noenhanced\nset xlabel '"
             << axis_name(panels[i].kind) << "'\nset ylabel 'E / π, all bounces'\nplot ";
      for (std::size_t k = 0; k < kShownAlbedos; ++k)
        script << "$fitted" << i << " using 1:" << k + 2 << " with lines " << albedo_style(k, kShownAlbedos)
               << " notitle, ";
      script << "for [k=2:" << kShownAlbedos + 1 << "] $measured" << i << " using 1:(column(k)) with lines "
             << kMeasuredStyle << " notitle\n";
    }
    std::string key = std::string("keyentry with lines ") + kMeasuredStyle + " title 'measured (bin means)'";
    for (std::size_t k = kShownAlbedos; k-- > 0;)
      key += fmt::format(", keyentry with lines {} title 'ρ = {:.1f}'", albedo_style(k, kShownAlbedos),
                         static_cast<double>(k) / 10);
    draw_key(script, grid, key);
    script << "unset multiplot\n";
  });
}

GnuplotResult draw_errors(bool is_svg, const std::vector<JudgedForm>& forms) {
  PanelGrid grid = make_grid(forms.size());
  grid.title = 58;                                             // two lines
  constexpr std::array<std::size_t, 5> kShown{0, 2, 4, 6, 8};  // of the judged albedos
  return run_gnuplot([&](Gnuplot& script) {
    script << "set terminal " << terminal_of(grid, is_svg) << '\n'
           << kShareAxisStyle << "set logscale y\nset yrange [2e-4:1]\nset format y '10^{%T}'\n";
    for (std::size_t i = 0; i < forms.size(); ++i) {
      send_table(script, "errors" + std::to_string(i), error_table(forms[i]));
    }
    begin_grid(script, grid,
               "RMS error of each form over its AO; over all texels at ρ = .1 .3 .5 .7 .9 in the titles");
    for (std::size_t i = 0; i < forms.size(); ++i) {
      place_panel(script, grid, i);
      script << "set title " << error_title(forms[i]) << " noenhanced\nset xlabel '"
             << axis_name(forms[i].kind) << "'\nset ylabel 'RMS error of E / π'\nplot ";
      for (std::size_t k = 0; k < kShown.size(); ++k)
        script << (k > 0 ? ", " : "") << "$errors" << i << " using 1:" << kShown[k] + 2 << " with lines "
               << albedo_style(k, kShown.size()) << " notitle";
      script << '\n';
    }
    std::string key;
    for (std::size_t k = 0; k < kShown.size(); ++k)
      key += fmt::format("{}keyentry with lines {} title 'ρ = {:.1f}'", k > 0 ? ", " : "",
                         albedo_style(k, kShown.size()), judged_albedos()[kShown[k]]);
    draw_key(script, grid, key);
    script << "unset multiplot\n";
  });
}

GnuplotResult draw_cubics(bool is_svg, const CubicPanel& cubics) {
  const PanelGrid grid = make_grid(3);
  return run_gnuplot([&](Gnuplot& script) {
    script << "set terminal " << terminal_of(grid, is_svg) << '\n' << kShareAxisStyle << std::setprecision(8);
    send_table(script, "three", coefficient_table(cubics.three_bounces));
    send_table(script, "all", coefficient_table(cubics.all_bounces));
    begin_grid(script, grid, "Coefficients of the cubic, by albedo");
    // Points at the ends of the range would lie half hidden on the border.
    script << "set xlabel 'albedo ρ'\nunset ylabel\nset yrange [*:*]\nset offsets 0, 0, graph 0.05, graph "
              "0.05\n";
    const CubicConstants& three = cubics.three_bounces_line;
    const CubicConstants& all = cubics.all_bounces_line;
    const CubicConstants published;
    place_panel(script, grid, 0);
    send_coefficient_panel(script, "a", 2,
                           {{{three.a_slope, three.a_offset},
                             {all.a_slope, all.a_offset},
                             {published.a_slope, published.a_offset}}});
    place_panel(script, grid, 1);
    send_coefficient_panel(script, "b", 3,
                           {{{three.b_slope, three.b_offset},
                             {all.b_slope, all.b_offset},
                             {published.b_slope, published.b_offset}}});
    place_panel(script, grid, 2);
    send_coefficient_panel(script, "c", 4,
                           {{{three.c_slope, three.c_offset},
                             {all.c_slope, all.c_offset},
                             {published.c_slope, published.c_offset}}});
    draw_key(script, grid,
             fmt::format(
                 "keyentry with points pt 7 lc rgb '{}' title 'fitted, three bounces', keyentry with points "
                 "pt 5 lc rgb '{}' title 'fitted, all bounces', keyentry with lines {} title 'published, "
                 "eq. 33'",
                 kThreeColour, kAllColour, kPublishedCubicStyle));
    script << "unset multiplot\n";
  });
}

void plot_fitted(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<FittedPanel>& panels) {
  write_bytes(svg, draw_fitted(true, panels).output);
  write_bytes(png, draw_fitted(false, panels).output);
}

void plot_errors(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<JudgedForm>& forms) {
  write_bytes(svg, draw_errors(true, forms).output);
  write_bytes(png, draw_errors(false, forms).output);
}

void plot_cubics(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const CubicPanel& cubics) {
  write_bytes(svg, draw_cubics(true, cubics).output);
  write_bytes(png, draw_cubics(false, cubics).output);
}

}  // namespace heightlight
