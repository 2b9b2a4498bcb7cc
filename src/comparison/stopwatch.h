#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>

namespace heightlight {

/// What a piece of work took, in seconds.
struct Cost {
  double seconds = 0;
  double core_seconds = 0;  ///< of processors, summed over the process' threads
};

/// Runs from where it is made.
class Stopwatch {
 public:
  Cost elapsed() const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_start_;
    return {wall.count(), process_seconds() - core_start_};
  }

 private:
  static double process_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }

  std::chrono::steady_clock::time_point wall_start_ = std::chrono::steady_clock::now();
  double core_start_ = process_seconds();
};

/// Runs the work three times, fewer where that takes more than half a second, and says what it took at least:
/// what other programs take from this one only ever adds.
template <class Work>
Cost least_cost(const Work& work) {
  constexpr int kRuns = 3;
  constexpr double kEnough = 0.5;
  Cost least;
  double spent = 0;
  for (int run = 0; run < kRuns && spent < kEnough; ++run) {
    const Stopwatch watch;
    work();
    const Cost cost = watch.elapsed();
    spent += cost.seconds;
    least.seconds = run == 0 ? cost.seconds : std::min(least.seconds, cost.seconds);
    least.core_seconds = run == 0 ? cost.core_seconds : std::min(least.core_seconds, cost.core_seconds);
  }
  return least;
}

}  // namespace heightlight
