#include "plot/pareto_plot.h"

#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/digits.h"
#include "comparison/comparison_csv.h"
#include "comparison/pareto_front.h"
#include "comparison/sky_comparison.h"
#include "files/output_file.h"
#include "plot/gnuplot_run.h"
#include "plot/panel_grid.h"

namespace heightlight {
namespace {

using gnuplotio::Gnuplot;
using Points = std::vector<std::array<double, 2>>;

constexpr const char* kParetoStyle = R"(
set encoding utf8
set logscale xy
set format x '10^{%T}'
set format y '10^{%T}'
set style line 100 lc rgb '#dddddd' lw 0.7
set grid ls 100 back
set border lw 0.8 lc rgb '#444444'
set tics scale 0.6 nomirror
set xlabel 'core-seconds'
)";

/// Okabe and Ito's colours for the colour-blind, then others.
constexpr std::array<const char*, 12> kColours{"#000000", "#999999", "#56b4e9", "#0072b2",
                                               "#004466", "#d55e00", "#009e73", "#cc79a7",
                                               "#e69f00", "#8b4513", "#aa3377", "#66aa00"};

/// gnuplot's point types, for what a method finds itself and for each form.
constexpr std::array<int, 14> kMarks{7, 2, 1, 3, 4, 8, 6, 10, 12, 14, 5, 9, 11, 13};

/// Different values of a member, in the order of the table, so that they look the same in all panels.
std::vector<std::string> names_of(const std::vector<ComparisonRow>& rows,
                                  std::string ComparisonRow::*member) {
  std::vector<std::string> names;
  for (const ComparisonRow& row : rows) {
    const std::string& name = row.*member;
    const bool is_direction = row.variant == kByNormal || row.variant == kByBentNormal;  // not a form
    if (row.method != kExactMethod && !is_direction &&
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return names;
}

/// An error of exactly 0 has no place on a logarithmic axis.
Points points_of(const std::vector<ComparisonRow>& rows, const std::string& quantity,
                 const std::string& method, const std::string& variant) {
  Points points;
  for (const ComparisonRow& row : rows) {
    const bool is_drawn = row.variant.empty() || row.shown;  // forms on all parameters would hide each other
    if (row.quantity == quantity && row.method == method && row.variant == variant && row.error.rmse > 0 &&
        is_drawn) {
      points.push_back({row.cost.core, row.error.rmse});
    }
  }
  return points;
}

void send_points(Gnuplot& script, const std::string& name, const Points& points) {
  script << '$' << name << " << e\n";
  for (const auto& [x, y] : points) script << x << ' ' << y << '\n';
  script << "e\n";
}

/// Ranges that show all points; on the left there is room for the labels of the front.
void send_ranges(Gnuplot& script, const std::vector<ComparisonRow>& rows, const ParetoPanel& panel) {
  double x_low = 1e-3, x_high = 1, y_low = 1e-3, y_high = 1e-1;
  bool any = false;
  for (const ComparisonRow& row : rows) {
    if (row.quantity != panel.quantity || row.method == kExactMethod || !(row.error.rmse > 0)) continue;
    const double x = row.cost.core;
    const double y = row.error.rmse;
    x_low = any ? std::min(x_low, x) : x;
    x_high = any ? std::max(x_high, x) : x;
    y_low = any ? std::min(y_low, y) : y;
    y_high = any ? std::max(y_high, y) : y;
    any = true;
  }
  if (panel.reference_error > 0) y_low = std::min(y_low, panel.reference_error);
  script << "set xrange [" << x_low / 2000 << ':' << x_high * 1.5 << "]\nset yrange [" << y_low / 1.8 << ':'
         << y_high * 1.5 << "]\n";
}

/// The front's points, and their parameters left of them; labels that would lie on top of each other are left
/// out, since all rows stand in the table.
Points send_front_labels(Gnuplot& script, const std::vector<ComparisonRow>& rows,
                         const std::string& quantity) {
  Points front;
  double last_labelled = 0;
  for (const ComparisonRow* row : pareto_front(rows, quantity)) {
    if (!(row->error.rmse > 0)) continue;
    front.push_back({row->cost.core, row->error.rmse});
    if (last_labelled > 0 && row->error.rmse > last_labelled / 1.6) continue;
    last_labelled = row->error.rmse;
    script << "set label " << gnuplot_quoted(parameters_and_variant(*row)) << " at " << row->cost.core << ','
           << row->error.rmse << " right offset -0.8,-0.5 font ',7' tc rgb '#555555' noenhanced front\n";
  }
  return front;
}

std::string colour_of(std::size_t method) { return kColours[method % kColours.size()]; }
std::string mark_of(std::size_t variant) { return std::to_string(kMarks[variant % kMarks.size()]); }

constexpr const char* kFrontStyle = "lw 1.4 lc rgb '#555555'";
constexpr const char* kReferenceStyle = "with lines lw 1.4 dt 3 lc rgb '#d5200e'";

/// All that a figure's rows tell apart.
struct Names {
  std::vector<std::string> methods;
  std::vector<std::string> variants;
};

void send_panel(Gnuplot& script, const std::vector<ComparisonRow>& rows, const ParetoPanel& panel,
                const Names& names) {
  send_ranges(script, rows, panel);
  script << "unset label\nset ylabel 'RMSE'\nset title " << gnuplot_quoted(panel.quantity)
         << " font ':Bold' noenhanced\n";
  send_points(script, "front", send_front_labels(script, rows, panel.quantity));
  std::string plot = std::string("plot $front using 1:2 with steps ") + kFrontStyle + " notitle";
  if (panel.reference_error > 0)
    plot += ", " + in_digits(panel.reference_error) + ' ' + kReferenceStyle + " notitle";
  for (std::size_t m = 0; m < names.methods.size(); ++m) {
    for (std::size_t v = 0; v < names.variants.size(); ++v) {
      const Points points = points_of(rows, panel.quantity, names.methods[m], names.variants[v]);
      if (points.empty()) continue;
      const std::string name = "points" + std::to_string(m) + "_" + std::to_string(v);
      send_points(script, name, points);
      plot += ", $" + name + " using 1:2 with points pt " + mark_of(v) + " ps 0.9 lc rgb '" + colour_of(m) +
              "' notitle";
    }
  }
  script << plot << '\n';
}

std::string key_of(const Names& names, bool has_reference) {
  std::string key = std::string("keyentry with lines ") + kFrontStyle + " title 'Pareto front'";
  if (has_reference)
    key += std::string(", keyentry ") + kReferenceStyle + " title \"the reference's own error\"";
  key += ", keyentry title ' '";
  for (std::size_t m = 0; m < names.methods.size(); ++m)
    key += ", keyentry with points pt 5 ps 1.2 lc rgb '" + colour_of(m) + "' title " +
           gnuplot_quoted(names.methods[m]);
  if (names.variants.size() <= 1) return key;
  key += ", keyentry title ' '";
  for (std::size_t v = 0; v < names.variants.size(); ++v)
    key += ", keyentry with points pt " + mark_of(v) + " ps 1 lc rgb '#444444' title " +
           gnuplot_quoted(names.variants[v].empty() ? "what it finds itself" : names.variants[v]);
  return key;
}

std::string draw(bool is_svg, const std::vector<ComparisonRow>& rows, const std::vector<ParetoPanel>& panels,
                 const std::string& title) {
  const Names names{names_of(rows, &ComparisonRow::method), names_of(rows, &ComparisonRow::variant)};
  const PanelGrid grid{.panels = panels.size(),
                       .columns = std::min<std::size_t>(2, panels.size()),
                       .width = 720,
                       .height = 560,
                       .key = 290};
  const bool has_reference = std::any_of(panels.begin(), panels.end(),
                                         [](const ParetoPanel& panel) { return panel.reference_error > 0; });
  return run_gnuplot([&](Gnuplot& script) {
           script << "set terminal " << terminal_of(grid, is_svg) << '\n' << kParetoStyle;
           begin_grid(script, grid, title);
           for (std::size_t i = 0; i < panels.size(); ++i) {
             place_panel(script, grid, i);
             send_panel(script, rows, panels[i], names);
           }
           draw_key(script, grid, key_of(names, has_reference));
           script << "unset multiplot\n";
         })
      .output;
}

}  // namespace

void plot_pareto(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<ComparisonRow>& rows, const std::vector<ParetoPanel>& panels,
                 const std::string& title) {
  write_bytes(svg, draw(true, rows, panels, title));
  write_bytes(png, draw(false, rows, panels, title));
}

}  // namespace heightlight
