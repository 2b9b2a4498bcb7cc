#pragma once

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <string>

namespace heightlight {

/// What a piece of work took, in seconds.
struct Cost {
  double wall = 0;
  double core = 0;    ///< processor seconds of this process, summed over its threads
  double others = 0;  ///< processor seconds of other programs meanwhile: they lengthen `wall`
};

inline Cost operator+(Cost a, Cost b) { return {a.wall + b.wall, a.core + b.core, a.others + b.others}; }
inline Cost operator*(double times, Cost cost) {
  return {times * cost.wall, times * cost.core, times * cost.others};
}

/// Starts when it is made.
class Stopwatch {
 public:
  Cost elapsed() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_start_;
    const double core = process_seconds() - core_start_;
    return {wall.count(), core, std::max(0.0, machine_seconds() - machine_start_ - core)};
  }

  /// Wall seconds since the last lap, or since the stopwatch was made.
  double lap() {
    const std::chrono::steady_clock::time_point now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> wall = now - lap_start_;
    lap_start_ = now;
    return wall.count();
  }

 private:
  static double process_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  /// Seconds that all processors have worked since the machine started, in steps of its clock (10 ms); 0
  /// where the system does not tell.
  static double machine_seconds() {
    std::ifstream file("/proc/stat");
    std::string cpu;
    double user = 0;
    double nice = 0;
    double system = 0;
    file >> cpu >> user >> nice >> system;
    return (user + nice + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  std::chrono::steady_clock::time_point wall_start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point lap_start_ = wall_start_;
  double machine_start_ = machine_seconds();
  double core_start_ = process_seconds();
};

/// The least wall time and the least core time of three runs, or of fewer once they have taken a second
/// together. The least is right because other programs can only add to the cost.
template <class Run>
Cost least_cost(const Run& run) {
  constexpr int kRuns = 3;
  constexpr double kEnough = 1;
  Cost least;
  double spent = 0;
  for (int i = 0; i < kRuns && spent < kEnough; ++i) {
    const Stopwatch watch;
    run();
    const Cost cost = watch.elapsed();
    spent += cost.wall;
    const double core = i == 0 ? cost.core : std::min(least.core, cost.core);
    if (i == 0 || cost.wall < least.wall) least = cost;
    least.core = core;
  }
  return least;
}

}  // namespace heightlight
