#include "plot/bounce_fit_plots.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "files/output_file.h"
#include "plot/colours.h"
#include "plot/panel_grid.h"

namespace heightlight {
namespace {

using gnuplotio::Gnuplot;

constexpr const char* kBandStyle = "fc rgb '#fbd9c6'";
constexpr const char* kMeanStyle = "lw 2.4 lc rgb '#D55E00'";
constexpr const char* kPublishedStyle = "lw 2 dt 4 lc rgb 'black'";
constexpr const char* kFittedStyle = "lw 2 lc rgb '#0072B2'";
constexpr int kDrawnPoints = 200;

/// α, F₀ and F₁ as published, then as fitted.
PlotTable notes_table(const NotesConstants& fitted) {
  PlotTable table;
  for (int i = 0; i <= kDrawnPoints; ++i) {
    const AmbientOcclusion alpha(static_cast<double>(i) / kDrawnPoints);
    table.push_back({alpha.value, notes_direct(alpha), notes_first_bounce(alpha), notes_direct(alpha, fitted),
                     notes_first_bounce(alpha, fitted)});
  }
  return table;
}

/// α, then each bounce's fit.
PlotTable fits_table(const std::vector<BounceFit>& fits) {
  PlotTable table;
  for (int i = 1; i < kDrawnPoints; ++i) {
    std::vector<double> row{static_cast<double>(i) / kDrawnPoints};
    for (const BounceFit& fit : fits)
      row.push_back(fit.fault.empty() ? evaluate_bounce(fit.constants, row[0]) : std::nan(""));
    table.push_back(row);
  }
  return table;
}

/// b, then value, low and high of each constant.
PlotTable constants_table(const std::vector<BounceFit>& fits) {
  PlotTable table{
      std::vector<double>(10, 1e9)};  // outside the axes: gnuplot complains of tables without a point
  for (const BounceFit& fit : fits) {
    if (!fit.fault.empty()) continue;
    std::vector<double> row{static_cast<double>(fit.bounce)};
    for (std::size_t c = 0; c < 3; ++c) {
      for (const double value : {fit.constants[c], fit.low[c], fit.high[c]}) row.push_back(value);
    }
    table.push_back(row);
  }
  return table;
}

/// E₀ or E₁ beside the notes' function of it.
void send_notes_panel(Gnuplot& script, int bounce) {
  script << "set title '{/:Bold "
         << (bounce == 0 ? "E_0 and F_0(α), notes eq. 7" : "E_1 and F_1(α), notes eq. 11")
         << "}'\nset xlabel 'ambient occlusion α (bin mean)'\nset ylabel 'E_" << bounce << " / π, ρ = 1'\n"
         << "set yrange [0:" << (bounce == 0 ? "1.05" : "0.5") << "]\n"
         << fmt::format(
                "plot $spread using 1:{}:{} with filledcurves {} notitle, $measured using 1:{} with lines {} "
                "notitle, "
                "$notes using 1:{} with lines {} notitle, $notes using 1:{} with lines {} notitle\n",
                2 + 2 * bounce, 3 + 2 * bounce, kBandStyle, 2 + bounce, kMeanStyle, 2 + bounce,
                kPublishedStyle, 4 + bounce, kFittedStyle);
}

void send_bounces_panel(Gnuplot& script, const std::vector<BounceFit>& fits) {
  script << "set title '{/:Bold Free fits A α (1−α)^{1.5} exp(−B α^C), bounce by bounce}'\n"
            "set ylabel 'E_b / π, ρ = 1'\nset logscale y\nset yrange [1e-4:1]\nset format y '10^{%T}'\nplot ";
  const std::size_t last = fits.empty() ? 0 : fits.back().bounce;
  for (std::size_t i = 0; i < fits.size(); ++i)
    script << (i > 0 ? ", " : "")
           << fmt::format(
                  "$measured using 1:{} with points pt 7 ps 0.35 {} notitle, $fits using 1:{} with lines lw "
                  "1.4 {} notitle",
                  2 + fits[i].bounce, order_style(fits[i].bounce, last), 2 + i,
                  order_style(fits[i].bounce, last));
  script << (fits.empty() ? "10 notitle" : "") << "\nunset logscale y\nset format y '%g'\n";
}

/// One constant over the bounce, with its intervals; the range holds the values, and what it can of the
/// intervals.
void send_constant_panel(Gnuplot& script, const std::vector<BounceFit>& fits, std::size_t constant) {
  double low = 1e9;
  double high = -1e9;
  for (const BounceFit& fit : fits) {
    if (!fit.fault.empty()) continue;
    low = std::min(low, fit.constants[constant]);
    high = std::max(high, fit.constants[constant]);
  }
  const bool is_gain = constant == 0;
  const double room = high > low ? 0.25 * (high - low) : 1;
  const bool any = low <= high;
  const std::string range = !any      ? std::string("[0.1:1]")
                            : is_gain ? fmt::format("[{:.6g}:{:.6g}]", low / 4, high * 4)
                                      : fmt::format("[{:.6g}:{:.6g}]", low - room, high + room);
  const int column = 2 + 3 * static_cast<int>(constant);
  script << "set title '{/:Bold "
         << "ABC"[constant] << " over the bounce}'\nset xlabel 'bounce b'\nset ylabel '"
         << "ABC"[constant] << "'\n"
         << (is_gain ? "set logscale y\n" : "")
         << "set xrange [0:" << (fits.empty() ? 1 : fits.back().bounce + 1)
         << "]\nset xtics autofreq\nset yrange " << range << '\n'
         << fmt::format("plot $constants using 1:{}:{}:{} with yerrorbars pt 7 ps 0.8 {} notitle\n", column,
                        column + 1, column + 2, kFittedStyle)
         << "unset logscale y\n";
}

std::string draw_bounce_fits(bool is_svg, const BounceFitPlotInput& input) {
  const PanelGrid grid{.panels = 6, .columns = 3, .width = 440};
  return run_gnuplot([&](Gnuplot& script) {
           script << "set terminal " << terminal_of(grid, is_svg) << '\n' << kShareAxisStyle;
           send_table(script, "measured", input.measured);
           send_table(script, "spread", input.spread);
           send_table(script, "notes", notes_table(input.notes));
           send_table(script, "fits", fits_table(input.fits));
           send_table(script, "constants", constants_table(input.fits));
           begin_grid(script, grid, "Single bounces of all maps together, and the notes' forms of them");
           place_panel(script, grid, 0);
           send_notes_panel(script, 0);
           place_panel(script, grid, 1);
           send_notes_panel(script, 1);
           place_panel(script, grid, 2);
           send_bounces_panel(script, input.fits);
           for (std::size_t c = 0; c < 3; ++c) {
             place_panel(script, grid, 3 + c);
             send_constant_panel(script, input.fits, c);
           }
           std::string key = fmt::format(
               "keyentry with filledcurves {} title '5 % to 95 % of texels', keyentry with lines {} title "
               "'measured "
               "(bin means)', keyentry with lines {} title 'published', keyentry with lines {} title 'fitted "
               "here, "
               "with 95 %', keyentry title ' '",
               kBandStyle, kMeanStyle, kPublishedStyle, kFittedStyle);
           const std::size_t last = input.fits.empty() ? 0 : input.fits.back().bounce;
           for (const BounceFit& fit : input.fits)
             key += fmt::format(", keyentry with lines lw 2 {} title 'b = {}'", order_style(fit.bounce, last),
                                fit.bounce);
           draw_key(script, grid, key);
           script << "unset multiplot\n";
         })
      .output;
}

}  // namespace

void plot_bounce_fits(const std::filesystem::path& svg, const std::filesystem::path& png,
                      const BounceFitPlotInput& input) {
  write_bytes(svg, draw_bounce_fits(true, input));
  write_bytes(png, draw_bounce_fits(false, input));
}

}  // namespace heightlight
