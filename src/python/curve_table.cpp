#include "python/curve_table.h"

#include <array>

#include "heightlight/error.h"
#include "python/arrays.h"

namespace heightlight {
namespace {

constexpr int kTail = -1;

/// Columns with the statistics of one bounce in a bin.
constexpr std::array kStatistics{
    std::pair{"mean", &BounceStatistics::mean}, std::pair{"stddev", &BounceStatistics::stddev},
    std::pair{"p05", &BounceStatistics::p05}, std::pair{"p50", &BounceStatistics::p50},
    std::pair{"p95", &BounceStatistics::p95}};
constexpr std::array kBinEdges{std::pair{"ao_lo", &CurveBin::ao_lo}, std::pair{"ao_hi", &CurveBin::ao_hi},
                               std::pair{"ao_mean", &CurveBin::ao_mean}};

/// Calls visit(bin, bounce, statistics) for each row.
template <class Visit>
void for_rows(const BounceCurves& curves, Visit&& visit) {
  for (const CurveBin& bin : curves.filled) {
    for (std::size_t b = 0; b < bin.bounces.size(); ++b) visit(bin, static_cast<int>(b), bin.bounces[b]);
    visit(bin, kTail, bin.tail);
  }
}

template <class T, class Value>
py::array_t<T> column(const BounceCurves& curves, Value&& value) {
  std::vector<T> values;
  for_rows(curves, [&](const CurveBin& bin, int bounce, const BounceStatistics& statistics) {
    values.push_back(static_cast<T>(value(bin, bounce, statistics)));
  });
  const auto count = static_cast<py::ssize_t>(values.size());
  return take_array(std::move(values), {count});
}

/// A column of a table; it must have `rows` values. Throws UsageError.
template <class T>
Array<T> read_column(const py::dict& table, const char* name, py::ssize_t rows) {
  if (!table.contains(name)) throw UsageError("curves", "", std::string("have no column ") + name);
  Array<T> values(table[name]);
  if (values.ndim() != 1 || (rows >= 0 && values.shape(0) != rows))
    throw UsageError("curves", "", std::string("have a column ") + name + " of another length");
  return values;
}

}  // namespace

py::dict curve_table(const BounceCurves& curves) {
  py::dict table;
  table["kind"] = to_string(curves.kind);
  table["bins"] = curves.bins;
  table["bin"] = column<std::int64_t>(curves, [](const CurveBin& bin, int, auto&) { return bin.bin; });
  table["count"] = column<std::int64_t>(curves, [](const CurveBin& bin, int, auto&) { return bin.count; });
  table["bounce"] = column<std::int64_t>(curves, [](auto&, int bounce, auto&) { return bounce; });
  for (const auto& edge : kBinEdges) {  // Clang 14 cannot capture structured bindings
    table[edge.first] =
        column<double>(curves, [&](const CurveBin& bin, int, auto&) { return bin.*edge.second; });
  }
  for (const auto& statistic : kStatistics) {
    table[statistic.first] = column<double>(
        curves, [&](auto&, int, const BounceStatistics& found) { return found.*statistic.second; });
  }
  return table;
}

BounceCurves read_curve_table(const py::dict& table) {
  BounceCurves curves;
  const std::string kind = table.contains("kind") ? py::str(table["kind"]) : py::str("");
  if (kind != to_string(AoKind::ambient_occlusion) && kind != to_string(AoKind::sky_view_factor))
    throw UsageError("curves", kind, "are of no kind of AO: ambient_occlusion or sky_view_factor");
  curves.kind =
      kind == to_string(AoKind::ambient_occlusion) ? AoKind::ambient_occlusion : AoKind::sky_view_factor;
  curves.bins = table.contains("bins") ? table["bins"].cast<int>() : 100;
  const Array<std::int64_t> bins = read_column<std::int64_t>(table, "bin", -1);
  const py::ssize_t rows = bins.shape(0);
  const Array<std::int64_t> counts = read_column<std::int64_t>(table, "count", rows);
  const Array<std::int64_t> bounces = read_column<std::int64_t>(table, "bounce", rows);
  std::vector<Array<double>> edges;
  for (const auto& [name, member] : kBinEdges) edges.push_back(read_column<double>(table, name, rows));
  std::vector<Array<double>> statistics;
  for (const auto& [name, member] : kStatistics) statistics.push_back(read_column<double>(table, name, rows));
  for (py::ssize_t row = 0; row < rows; ++row) {
    if (curves.filled.empty() || curves.filled.back().bin != bins.at(row)) {
      CurveBin& bin = curves.filled.emplace_back();
      bin.bin = static_cast<int>(bins.at(row));
      bin.count = static_cast<std::size_t>(counts.at(row));
      for (std::size_t i = 0; i < kBinEdges.size(); ++i) bin.*kBinEdges.at(i).second = edges[i].at(row);
    }
    CurveBin& bin = curves.filled.back();
    const bool is_tail = bounces.at(row) == kTail;
    if (!is_tail && bounces.at(row) != static_cast<std::int64_t>(bin.bounces.size()))
      throw UsageError("curves", "", "have bounces out of order");
    BounceStatistics& found = is_tail ? bin.tail : bin.bounces.emplace_back();
    for (std::size_t i = 0; i < kStatistics.size(); ++i)
      found.*kStatistics.at(i).second = statistics[i].at(row);
  }
  return curves;
}

}  // namespace heightlight
