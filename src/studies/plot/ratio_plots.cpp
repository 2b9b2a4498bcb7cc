#include "plot/ratio_plots.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>

#include "files/output_file.h"
#include "plot/colours.h"
#include "plot/panel_grid.h"

namespace heightlight {
namespace {

using gnuplotio::Gnuplot;

constexpr const char* kPublishedTauStyle = "lw 2 dt 4 lc rgb 'black'";

/// α, eq. 9 on the data, eq. 9 published, then E₂/E₁ …; a row of NaN where bins are missing.
PlotTable ratio_table(const BounceRatios& ratios) {
  PlotTable table;
  for (const RatioBin& bin : ratios.bins) {
    std::vector<double> row{bin.ao, bin.by_conservation, bin.published};
    row.insert(row.end(), bin.ratios.begin(), bin.ratios.end());
    table.push_back(row);
  }
  if (table.empty()) table.push_back(std::vector<double>(4, 10));
  return table;
}

std::size_t count_ratios(const BounceRatios& ratios) {
  return ratios.bins.empty() ? 0 : ratios.bins.front().ratios.size();
}

constexpr const char* kDataTauStyle = "lw 2.4 dt 2 lc rgb '#D55E00'";

std::string draw_ratios(bool is_svg, const std::vector<BounceRatios>& ratios) {
  const PanelGrid grid{.panels = std::max<std::size_t>(1, ratios.size()),
                       .columns = std::min<std::size_t>(3, std::max<std::size_t>(1, ratios.size())),
                       .width = 430,
                       .height = 380};
  std::size_t most = 1;
  for (const BounceRatios& one : ratios) most = std::max(most, count_ratios(one));
  return run_gnuplot([&](Gnuplot& script) {
           script << "set terminal " << terminal_of(grid, is_svg) << '\n'
                  << kShareAxisStyle << "set yrange [-0.2:1]\n";
           begin_grid(script, grid, "Is τ one number? Ratios of successive bounces over α, and τ by eq. 9");
           for (std::size_t i = 0; i < ratios.size(); ++i) {
             send_table(script, "ratios" + std::to_string(i), ratio_table(ratios[i]));
             place_panel(script, grid, i);
             script << "set title "
                    << gnuplot_quoted(fmt::format("{}, spread {:.2f}", ratios[i].map, ratios[i].spread))
                    << " font ':Bold' noenhanced\nset xlabel 'ambient occlusion α (bin mean)'\n"
                    << "set ylabel 'ratio of bounces'\nplot ";
             for (std::size_t b = 1; b <= count_ratios(ratios[i]); ++b)
               script << fmt::format("$ratios{} using 1:{} with lines lw 1.3 {} notitle, ", i, 3 + b,
                                     order_style(b, most));
             script << fmt::format(
                 "$ratios{} using 1:2 with lines {} notitle, $ratios{} using 1:3 with lines {} "
                 "notitle\n",
                 i, kDataTauStyle, i, kPublishedTauStyle);
           }
           std::string key = fmt::format(
               "keyentry with lines {} title 'τ by eq. 9, these data', keyentry with lines {} title 'τ as "
               "published', "
               "keyentry title ' '",
               kDataTauStyle, kPublishedTauStyle);
           for (std::size_t b = 1; b <= most; ++b)
             key += fmt::format(", keyentry with lines lw 2 {} title 'E{} / E{}'", order_style(b, most),
                                b + 1, b);
           draw_key(script, grid, key);
           script << "unset multiplot\n";
         })
      .output;
}

std::string draw_saturation(bool is_svg, const PlotTable& measured) {
  constexpr std::array<double, 6> kTaus{0, 0.2, 0.4, 0.6, 0.8, 0.9};
  const PanelGrid grid{.panels = 1, .columns = 1, .width = 760, .height = 620, .key = 260};
  return run_gnuplot([&](Gnuplot& script) {
           script << "set terminal " << terminal_of(grid, is_svg) << '\n'
                  << kShareAxisStyle << "set yrange [0:1]\nset palette defined (";
           for (int i = 0; i <= 10; ++i)
             script << (i > 0 ? ", " : "") << fmt::format("{} '{}'", 0.1 * i, ordered_colour(0.1 * i));
           script << ")\nset cbrange [0:1]\nunset colorbox\n";
           PlotTable points = measured;
           if (points.empty()) points.push_back({10, 10, 0});
           send_table(script, "measured", points);
           begin_grid(script, grid, "How bounces saturate colour");
           place_panel(script, grid, 0);
           script << "set xlabel 'albedo ρ of a channel'\nset ylabel 'what bounces bring, over that at ρ = "
                     "1'\nplot ";
           for (const double tau : kTaus)
             script << fmt::format("x*(1-{0})/(1-x*{0}) with lines lw 2 lc rgb '{1}' notitle, ", tau,
                                   ordered_colour(tau));
           script << "$measured using 1:2:3 with points pt 7 ps 0.8 lc palette notitle\n";
           std::string key =
               "keyentry with points pt 7 ps 1 lc rgb '#444444' title 'measured, by its τ (eq. 9)'";
           for (const double tau : kTaus)
             key += fmt::format(", keyentry with lines lw 2 lc rgb '{}' title 'series, τ = {:g}'",
                                ordered_colour(tau), tau);
           draw_key(script, grid, key);
           script << "unset multiplot\n";
         })
      .output;
}

}  // namespace

void plot_ratios(const std::filesystem::path& svg, const std::filesystem::path& png,
                 std::vector<BounceRatios> ratios) {
  constexpr std::size_t kMostPanels = 12;
  std::stable_sort(ratios.begin(), ratios.end(),
                   [](const BounceRatios& a, const BounceRatios& b) { return a.spread < b.spread; });
  std::vector<BounceRatios> shown;
  const std::size_t count = std::min(kMostPanels, ratios.size());
  for (std::size_t i = 0; i < count; ++i)
    shown.push_back(ratios[count > 1 ? i * (ratios.size() - 1) / (count - 1) : 0]);
  write_bytes(svg, draw_ratios(true, shown));
  write_bytes(png, draw_ratios(false, shown));
}

void plot_saturation(const std::filesystem::path& svg, const std::filesystem::path& png,
                     const PlotTable& measured) {
  write_bytes(svg, draw_saturation(true, measured));
  write_bytes(png, draw_saturation(false, measured));
}

}  // namespace heightlight
