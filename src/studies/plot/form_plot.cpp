#include "plot/form_plot.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "files/output_file.h"
#include "plot/gnuplot_run.h"
#include "plot/panel_grid.h"

namespace heightlight {
namespace {

using gnuplotio::Gnuplot;

/// A colour and dashes for each form, the same in all panels; a user's own come after those of the list.
struct LineStyle {
  const char* form;
  const char* colour;
  int dashes;
};
constexpr std::array<LineStyle, 6> kStyles{{{"direct", "#888888", 2},
                                            {"notes", "#000000", 1},
                                            {"uniform_neighbourhood", "#0072b2", 1},
                                            {"cubic", "#009e73", 4},
                                            {"seen_from_sky", "#cc79a7", 1},
                                            {"seen_stored", "#7b3294", 3}}};
constexpr std::array<const char*, 4> kOwnColours{"#e69f00", "#8b4513", "#56b4e9", "#66aa00"};

/// Of the forms of all panels, in order: name, label and style.
struct DrawnForm {
  std::string form;
  std::string label;
  std::string style;
};

std::vector<DrawnForm> list_drawn(const std::vector<FormPanel>& panels) {
  std::vector<DrawnForm> drawn;
  std::size_t own = 0;
  for (const FormPanel& panel : panels) {
    for (const PanelCurve& curve : panel.curves) {
      if (std::any_of(drawn.begin(), drawn.end(),
                      [&](const DrawnForm& one) { return one.form == curve.form; }))
        continue;
      const auto known = std::find_if(kStyles.begin(), kStyles.end(),
                                      [&](const LineStyle& style) { return curve.form == style.form; });
      drawn.push_back(
          {curve.form, curve.label,
           known != kStyles.end()
               ? fmt::format("lw 2 dt {} lc rgb '{}'", known->dashes, known->colour)
               : fmt::format("lw 2.4 dt 5 lc rgb '{}'", kOwnColours[own++ % kOwnColours.size()])});
    }
  }
  return drawn;
}

constexpr const char* kBand = "fc rgb '#fbd9c6'";
constexpr const char* kMean = "lw 3 lc rgb '#d55e00'";

void send_panel(Gnuplot& script, const FormPanel& panel, const std::vector<DrawnForm>& drawn) {
  const bool over_alpha = panel.kind == AoKind::ambient_occlusion;
  PlotTable measured;
  for (const PanelBin& bin : panel.measured) measured.push_back({bin.ao, bin.mean, bin.low, bin.high});
  // gnuplot complains of tables without a valid point: these are outside the axes
  if (measured.empty()) measured.assign(2, {10, 10, 10, 10});
  send_table(script, "measured", measured);
  std::string plot = fmt::format(
      "plot $measured using 1:3:4 with filledcurves {} notitle, $measured using 1:2 with lines {} notitle",
      kBand, kMean);
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    PlotTable curve{{10, 10}, {std::nan(""), std::nan("")}};
    for (const auto& [ao, total] : panel.curves[i].points) curve.push_back({ao, total});
    send_table(script, "curve" + std::to_string(i), curve);
    const auto style = std::find_if(drawn.begin(), drawn.end(),
                                    [&](const DrawnForm& one) { return one.form == panel.curves[i].form; });
    plot += fmt::format(", $curve{} using 1:2 with lines {} notitle", i, style->style);
  }
  script << "set title " << gnuplot_quoted(panel.role + ", albedo " + panel.albedo)
         << " font ':Bold' noenhanced\n"
         << "set xlabel " << gnuplot_quoted((over_alpha ? "α, " : "A, ") + panel.role + " (bin mean)")
         << " noenhanced\n"
         << "set ylabel 'E / π, all bounces'\n"
         << plot << '\n';
}

std::string draw(bool is_svg, const std::vector<FormPanel>& panels, const std::string& title) {
  PanelGrid grid{.panels = std::max<std::size_t>(1, panels.size())};
  while (grid.columns < panels.size() && panels[grid.columns].albedo != panels[0].albedo) ++grid.columns;
  const std::vector<DrawnForm> drawn = list_drawn(panels);
  return run_gnuplot([&](Gnuplot& script) {
           script << "set terminal " << terminal_of(grid, is_svg) << '\n'
                  << kShareAxisStyle << "set yrange [0:1.05]\n";
           begin_grid(script, grid, title);
           for (std::size_t i = 0; i < panels.size(); ++i) {
             place_panel(script, grid, i);
             send_panel(script, panels[i], drawn);
           }
           std::string key = fmt::format(
               "keyentry with filledcurves {} title '5 % to 95 % of texels', keyentry with lines {} title "
               "'measured, "
               "mean'",
               kBand, kMean);
           for (const DrawnForm& one : drawn)
             key += ", keyentry with lines " + one.style + " title " + gnuplot_quoted(one.label);
           draw_key(script, grid, key);
           script << "unset multiplot\n";
         })
      .output;
}

}  // namespace

void plot_forms(const std::filesystem::path& svg, const std::filesystem::path& png,
                const std::vector<FormPanel>& panels, const std::string& title) {
  write_bytes(svg, draw(true, panels, title));
  write_bytes(png, draw(false, panels, title));
}

}  // namespace heightlight
