#pragma once

#include <chrono>

namespace heightlight {

class StopWatch {
 public:
  /// Seconds since the last call, or since the watch was made.
  double lap() {
    const Clock::time_point now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return seconds;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

}  // namespace heightlight
