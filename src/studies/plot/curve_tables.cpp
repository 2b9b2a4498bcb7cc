#include "plot/curve_tables.h"

#include <algorithm>
#include <functional>
#include <limits>

namespace heightlight {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kOutside = 10;  // of every axis of ratios, and good for a logarithm

/// `row` gives a bin's columns, ao_mean first. A bin between empty ones becomes a dash of its own width: a
/// line needs two points.
PlotTable make_table(const BounceCurves& curves, std::size_t columns,
                     const std::function<std::vector<double>(const CurveBin&)>& row) {
  PlotTable table;
  const std::vector<double> gap(columns, kNothing);
  const std::vector<CurveBin>& filled = curves.filled;
  for (std::size_t i = 0; i < filled.size(); ++i) {
    const bool follows = i > 0 && filled[i - 1].bin + 1 == filled[i].bin;
    const bool leads = i + 1 < filled.size() && filled[i + 1].bin == filled[i].bin + 1;
    if (i > 0 && !follows) table.push_back(gap);
    table.push_back(row(filled[i]));
    if (follows || leads) continue;
    table.push_back(table.back());
    table[table.size() - 2][0] = filled[i].ao_lo;
    table.back()[0] = filled[i].ao_hi;
  }
  if (table.empty()) table.emplace_back(columns, kOutside);
  return table;
}

}  // namespace

int last_bounce(const BounceCurves& curves) {
  return curves.filled.empty() ? 0 : static_cast<int>(curves.filled.front().bounces.size()) - 1;
}

BounceCurves well_filled(const BounceCurves& curves) {
  std::size_t texels = 0;
  for (const CurveBin& bin : curves.filled) texels += bin.count;
  const std::size_t fewest = std::max<std::size_t>(30, texels / 400);
  BounceCurves filled = curves;
  std::erase_if(filled.filled, [fewest](const CurveBin& bin) { return bin.count < fewest; });
  return filled;
}

PlotTable bounce_table(const BounceCurves& curves) {
  const auto bounces = static_cast<std::size_t>(last_bounce(curves) + 1);
  return make_table(curves, 6 + bounces, [](const CurveBin& bin) {
    const BounceStatistics& direct = bin.bounces.front();
    std::vector<double> row{bin.ao_mean,
                            (bin.ao_lo + bin.ao_hi) / 2,
                            bin.ao_hi - bin.ao_lo,
                            static_cast<double>(bin.count),
                            direct.p05,
                            direct.p95};
    for (const BounceStatistics& bounce : bin.bounces) row.push_back(bounce.mean);
    return row;
  });
}

PlotTable sum_table(const BounceCurves& curves) {
  const auto bounces = static_cast<std::size_t>(last_bounce(curves) + 1);
  return make_table(curves, 2 + bounces, [](const CurveBin& bin) {
    std::vector<double> row{bin.ao_mean};
    double sum = 0;
    for (const BounceStatistics& bounce : bin.bounces) row.push_back(sum += bounce.mean);
    row.push_back(sum + bin.tail.mean);
    return row;
  });
}

std::vector<PlotTable> surface_table(const BounceCurves& curves) {
  constexpr int kMostPoints = 100;
  const int points = std::min(curves.bins, kMostPoints);
  const auto point_of = [&](const CurveBin& bin) {
    return static_cast<std::size_t>(static_cast<long long>(bin.bin) * points / curves.bins);
  };
  std::vector<double> count(static_cast<std::size_t>(points), 0);
  std::vector<double> ao(count.size(), 0);
  for (const CurveBin& bin : curves.filled) {
    count[point_of(bin)] += static_cast<double>(bin.count);
    ao[point_of(bin)] += static_cast<double>(bin.count) * bin.ao_mean;
  }
  std::vector<PlotTable> scans;
  for (int b = 1; b <= last_bounce(curves); ++b) {
    std::vector<double> mean(count.size(), 0);
    for (const CurveBin& bin : curves.filled) {
      mean[point_of(bin)] += static_cast<double>(bin.count) * bin.bounces[static_cast<std::size_t>(b)].mean;
    }
    PlotTable scan;
    for (std::size_t i = 0; i < count.size(); ++i) {
      const double x = count[i] > 0 ? ao[i] / count[i] : (static_cast<double>(i) + 0.5) / points;
      scan.push_back({x, static_cast<double>(b), count[i] > 0 ? mean[i] / count[i] : kNothing});
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

}  // namespace heightlight
