#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>

namespace heightlight {

/// A progress bar with the time left, on stderr: drawn on a terminal only, and only for work of more than a
/// second. `add` may be called from any thread.
class Progress {
 public:
  /// `total` units of work; 0 where nobody knows, which shows the time spent instead. A silent bar (`quiet`)
  /// draws nothing.
  Progress(std::string label, std::int64_t total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void add(std::int64_t units);

  /// What every bar begins with from now on: where in a longer job this work stands. Empty for nothing.
  static void set_context(std::string context);

 private:
  void draw(double seconds, std::int64_t done);

  std::string label_;
  std::int64_t total_;
  bool draws_;
  std::atomic<bool> drawn_{false};
  std::chrono::steady_clock::time_point start_;
  std::atomic<std::int64_t> done_{0};
  std::atomic<std::int64_t> next_draw_ms_{1000};
};

}  // namespace heightlight
