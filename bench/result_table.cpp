#include "result_table.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "base/parallel.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// The cheapest baseline that reaches the target; null if none does.
const TimeToError* find_baseline(const std::vector<TimeToError>& results, double target) {
  const TimeToError* cheapest = nullptr;
  for (const TimeToError& result : results) {
    if (!result.is_baseline || !result.reached || result.target != target) continue;
    if (!cheapest || result.total().core < cheapest->total().core) cheapest = &result;
  }
  return cheapest;
}

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::string format_ratio(double ratio) {
  if (std::isnan(ratio)) return "-";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", ratio);
  return text.data();
}

double share_of_others(const Cost& cost) { return cost.wall > 0 ? cost.others / cost.wall : 0; }

void print_head() {
  std::printf("%-6s %-26s %-14s %9s %8s %8s %8s %6s %9s %9s\n", "RMSE", "method", "setting", "measured",
              "set-up", "core-s", "wall-s", "others", "core gain", "wall gain");
}

void print_row(const TimeToError& result, double core_gain, double wall_gain) {
  const std::string setting = std::to_string(result.setting) + " " + result.parameter;
  const Cost total = result.total();
  std::printf("%-6g %-26s %-14s %9.5f %8.3f %8.3f %8.3f %6.2f %9s %9s%s%s\n", result.target,
              result.method.c_str(), setting.c_str(), result.rmse, result.set_up.core, total.core, total.wall,
              share_of_others(total), format_ratio(core_gain).c_str(), format_ratio(wall_gain).c_str(),
              result.extrapolated ? " *" : "", result.reached ? "" : " not reached");
}

void print_threads(const TimeToError& result) {
  const Cost& one = result.run_by_one_thread;
  if (one.wall == 0) return;
  std::printf("threads: %s: 1 takes %.3f s (others %.2f), %d take %.3f s (others %.2f): %.2f times as fast\n",
              result.method.c_str(), one.wall, share_of_others(one), thread_count(), result.run.wall,
              share_of_others(result.run), one.wall / result.run.wall);
}

}  // namespace

void ResultTable::add(const RaceName& race, const std::vector<TimeToError>& results) {
  print_head();
  for (const TimeToError& result : results) {
    const TimeToError* baseline = find_baseline(results, result.target);
    const bool compares = baseline && result.reached;
    const double core_gain = compares ? baseline->total().core / result.total().core : kNone;
    const double wall_gain = compares ? baseline->total().wall / result.total().wall : kNone;
    rows_.push_back({race, result, core_gain, wall_gain});
    print_row(result, core_gain, wall_gain);
  }
  for (const TimeToError& result : results) print_threads(result);
  std::fflush(stdout);
}

void ResultTable::write_csv(const std::string& path) const {
  std::ofstream file(path);
  file << "quantity,map,size,target_rmse,method,parameter,setting,reached,rmse,set_up_core_s,core_s,wall_s,"
          "others_core_s,core_gain,wall_gain,extrapolated,run_wall_s,run_wall_1_thread_s\n";
  for (const Row& row : rows_) {
    const TimeToError& r = row.result;
    const Cost total = r.total();
    file << row.race.quantity << ',' << row.race.map << ',' << row.race.size << ',' << r.target << ",\""
         << r.method << "\"," << r.parameter << ',' << r.setting << ',' << r.reached << ',' << r.rmse << ','
         << r.set_up.core << ',' << total.core << ',' << total.wall << ',' << total.others << ','
         << row.core_gain << ',' << row.wall_gain << ',' << r.extrapolated << ',' << r.run.wall << ','
         << r.run_by_one_thread.wall << '\n';
  }
  file.close();
  if (!file) throw Error(path + ": could not be written");
}

void CurveTable::add(const RaceName& race, const std::vector<CurvePoint>& curve) {
  for (const CurvePoint& point : curve) rows_.push_back({race, point});
}

void CurveTable::write_csv(const std::string& path) const {
  std::ofstream file(path);
  file << "quantity,map,size,method,parameter,setting,rmse,set_up_core_s,core_s,core_s_per_megatexel,wall_s,"
          "others_core_s,extrapolated\n";
  for (const Row& row : rows_) {
    const CurvePoint& p = row.point;
    const Cost total = p.total();
    const double megatexels = 1e-6 * row.race.size * row.race.size;
    file << row.race.quantity << ',' << row.race.map << ',' << row.race.size << ",\"" << p.method << "\","
         << p.parameter << ',' << p.setting << ',' << p.rmse << ',' << p.set_up.core << ',' << total.core
         << ',' << total.core / megatexels << ',' << total.wall << ',' << total.others << ','
         << p.extrapolated << '\n';
  }
  file.close();
  if (!file) throw Error(path + ": could not be written");
}

}  // namespace heightlight
