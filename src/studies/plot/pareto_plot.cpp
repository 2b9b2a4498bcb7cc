#include "plot/pareto_plot.h"

#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "comparison/pareto_front.h"
#include "files/output_file.h"
#include "plot/gnuplot_run.h"

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
set key outside right top Left reverse samplen 1 spacing 1.15 noenhanced
)";

/// Okabe and Ito's colours for the colour-blind, then greys; with the point type they tell methods apart.
struct Mark {
  const char* colour;
  int point;
};
constexpr std::array<Mark, 12> kMarks{{{"#000000", 5},
                                       {"#999999", 4},
                                       {"#56b4e9", 9},
                                       {"#0072b2", 11},
                                       {"#004466", 13},
                                       {"#d55e00", 7},
                                       {"#009e73", 6},
                                       {"#cc79a7", 8},
                                       {"#e69f00", 10},
                                       {"#8b4513", 12},
                                       {"#aa3377", 2},
                                       {"#66aa00", 1}}};

/// Methods in the order of the table, so that a method looks the same in all panels.
std::vector<std::string> methods_of(const std::vector<ComparisonRow>& rows) {
  std::vector<std::string> methods;
  for (const ComparisonRow& row : rows) {
    if (row.method != kExactMethod &&
        std::find(methods.begin(), methods.end(), row.method) == methods.end()) {
      methods.push_back(row.method);
    }
  }
  return methods;
}

/// Points of a method; an error of exactly 0 has no place on a logarithmic axis.
Points points_of(const std::vector<ComparisonRow>& rows, const std::string& quantity,
                 const std::string& method) {
  Points points;
  for (const ComparisonRow& row : rows) {
    if (row.quantity == quantity && row.method == method && row.error.rmse > 0) {
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
void send_ranges(Gnuplot& script, const std::vector<ComparisonRow>& rows, const std::string& quantity) {
  double x_low = 1e-3, x_high = 1, y_low = 1e-3, y_high = 1e-1;
  bool any = false;
  for (const ComparisonRow& row : rows) {
    if (row.quantity != quantity || row.method == kExactMethod || !(row.error.rmse > 0)) continue;
    const double x = row.cost.core;
    const double y = row.error.rmse;
    x_low = any ? std::min(x_low, x) : x;
    x_high = any ? std::max(x_high, x) : x;
    y_low = any ? std::min(y_low, y) : y;
    y_high = any ? std::max(y_high, y) : y;
    any = true;
  }
  script << "set xrange [" << x_low / 200 << ':' << x_high * 1.5 << "]\nset yrange [" << y_low / 1.5 << ':'
         << y_high * 1.5 << "]\n";
}

void send_panel(Gnuplot& script, const std::vector<ComparisonRow>& rows, const std::string& quantity) {
  const std::vector<std::string> methods = methods_of(rows);
  send_ranges(script, rows, quantity);
  script << "set ylabel 'RMSE'\nset title " << gnuplot_quoted(quantity) << " font ':Bold' noenhanced\n";
  std::string plot = "plot $front using 1:2 with steps lw 1.4 lc rgb '#555555' title 'Pareto front'";
  Points front;
  std::string labels;
  double last_labelled = 0;
  for (const ComparisonRow* row : pareto_front(rows, quantity)) {
    if (!(row->error.rmse > 0)) continue;
    front.push_back({row->cost.core, row->error.rmse});
    // Labels that would lie on top of each other are left out; all rows stand in the table.
    if (last_labelled > 0 && row->error.rmse > last_labelled / 1.6) continue;
    last_labelled = row->error.rmse;
    labels += "set label " + gnuplot_quoted(row->parameters) + " at " + std::to_string(row->cost.core) + "," +
              std::to_string(row->error.rmse) +
              " right offset -0.8,-0.5 font ',7' tc rgb '#555555' noenhanced front\n";
  }
  send_points(script, "front", front);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const Points points = points_of(rows, quantity, methods[i]);
    if (points.empty()) continue;
    const std::string name = "method" + std::to_string(i);
    send_points(script, name, points);
    const Mark& mark = kMarks[i % kMarks.size()];
    plot += ", $" + name + " using 1:2 with points pt " + std::to_string(mark.point) + " ps 0.9 lc rgb '" +
            mark.colour + "' title " + gnuplot_quoted(methods[i]);
  }
  script << "unset label\n" << labels << plot << '\n';
}

std::string draw(const std::string& terminal, const std::vector<ComparisonRow>& rows,
                 const std::vector<std::string>& quantities, const std::string& title) {
  const int columns = quantities.size() > 1 ? 2 : 1;
  const int lines = (static_cast<int>(quantities.size()) + columns - 1) / columns;
  return run_gnuplot([&](Gnuplot& script) {
           script << "set terminal " << terminal << " size " << 900 * columns << ',' << 620 * lines + 40
                  << " font 'sans,12' background 'white'\n"
                  << kParetoStyle << "set multiplot layout " << lines << ',' << columns << " title "
                  << gnuplot_quoted(title) << " font ':Bold,16' noenhanced\n";
           for (const std::string& quantity : quantities) send_panel(script, rows, quantity);
           script << "unset multiplot\n";
         })
      .output;
}

}  // namespace

void plot_pareto(const std::filesystem::path& svg, const std::filesystem::path& png,
                 const std::vector<ComparisonRow>& rows, const std::vector<std::string>& quantities,
                 const std::string& title) {
  write_bytes(svg, draw("svg", rows, quantities, title));
  write_bytes(png, draw("pngcairo", rows, quantities, title));
}

}  // namespace heightlight
