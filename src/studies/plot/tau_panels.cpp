#include "plot/tau_panels.h"

#include <fmt/core.h>
#include <gnuplot-iostream.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/bounce_ratios.h"
#include "fit/judged_map.h"
#include "plot/colours.h"
#include "plot/curve_tables.h"
#include "plot/gnuplot_run.h"

namespace heightlight {
namespace {

using gnuplotio::Gnuplot;

constexpr std::array<double, 4> kSaturationAlphas{0.2, 0.4, 0.6, 0.8};

/// The fullest bin within 0.05 of an α; null where there is none.
const CurveBin* bin_near(const BounceCurves& curves, double alpha) {
  constexpr double kNear = 0.05;
  const CurveBin* fullest = nullptr;
  for (const CurveBin& bin : curves.filled) {
    if (std::abs(bin.ao_mean - alpha) < kNear && (!fullest || bin.count > fullest->count)) fullest = &bin;
  }
  return fullest;
}

/// ρ, and what bounces bring there over what they bring at 1.
PlotTable saturation_table(const CurveBin& bin) {
  PlotTable table;
  const double direct = bin.bounces.front().mean;
  for (int k = 1; k < 20; ++k) {
    const double albedo = k / 20.0;
    table.push_back({albedo, (bin_total(bin, albedo) - direct) / (1 - direct)});
  }
  return table;
}

/// The bins that are drawn, each with its α; those without a bounce are left out.
std::vector<std::pair<double, const CurveBin*>> saturation_bins(const BounceCurves& curves) {
  std::vector<std::pair<double, const CurveBin*>> bins;
  for (const double alpha : kSaturationAlphas) {
    const CurveBin* bin = bin_near(curves, alpha);
    if (bin && bin->bounces.size() > 1 && bin->bounces[0].mean < 1) bins.emplace_back(alpha, bin);
  }
  return bins;
}

}  // namespace

void send_tau_tables(Gnuplot& script, const BounceCurves& over_alpha) {
  // gnuplot complains of tables without a valid point: the first is outside the axes, tied to no other
  const auto columns = static_cast<std::size_t>(3 + last_bounce(over_alpha));
  PlotTable table{std::vector<double>(columns, 10), std::vector<double>(columns, std::nan(""))};
  for (const RatioBin& bin : find_bounce_ratios("", over_alpha).bins) {
    std::vector<double> row{bin.ao, bin.by_conservation, bin.published};
    row.insert(row.end(), bin.ratios.begin(), bin.ratios.end());
    table.push_back(std::move(row));
  }
  send_table(script, "ratios", table);
  std::size_t number = 0;
  for (const auto& [alpha, bin] : saturation_bins(over_alpha))
    send_table(script, "saturation" + std::to_string(number++), saturation_table(*bin));
}

void send_ratio_panel(Gnuplot& script, const BounceCurves& over_alpha) {
  script << R"(
set title '{/:Bold Is τ one number? E_{b+1} / E_b}'
set xlabel 'ambient occlusion α (bin mean)'
set ylabel 'ratio of successive bounces'
set yrange [-0.2:1]
set key bottom left title ''
plot )";
  const int last = last_bounce(over_alpha);
  for (int b = 1; b < last; ++b)
    script << fmt::format("$ratios using 1:{} with lines lw 1.4 lc palette cb {} notitle, ", 3 + b, b);
  script << "$ratios using 1:2 with lines lw 2.2 dt 2 lc rgb '#D55E00' title 'τ by eq. 9, these data', "
            "$ratios using 1:3 with lines lw 1.6 dt 4 lc rgb 'black' title 'τ as published'\n";
}

void send_saturation_panel(Gnuplot& script, const BounceCurves& over_alpha) {
  script << R"(
set title '{/:Bold What a darker wall keeps of its bounces}'
set xlabel 'albedo ρ (of a channel)'
set ylabel 'bounces at ρ, over those at 1'
set yrange [0:1]
set key top left title 'points: measured; lines: series of τ'
plot x with lines lw 1 dt 3 lc rgb '#888888' title 'τ = 0')";
  std::size_t number = 0;
  for (const auto& [alpha, bin] : saturation_bins(over_alpha)) {
    const double tau = 1 - bin->bounces[1].mean / (1 - bin->bounces[0].mean);
    script << fmt::format(
        ", x*(1-({0:.6f}))/(1-x*({0:.6f})) with lines lw 1.4 lc rgb '{1}' title 'α = {3:.1f}: τ = {0:.2f}', "
        "$saturation{2} using 1:2 with points pt 7 ps 0.7 lc rgb '{1}' notitle",
        tau, ordered_colour(alpha), number++, alpha);
  }
  script << '\n';
}

}  // namespace heightlight
