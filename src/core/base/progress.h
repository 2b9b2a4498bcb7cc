#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "heightlight/watch.h"

namespace heightlight {

/// One step of long work, as its watch is told of it. `add` may be called from any thread.
class Progress {
 public:
  /// `total` units of work; 0 where the number is unknown. `watch` must outlive the step.
  Progress(std::string name, std::int64_t total, const Watch& watch);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void add(std::int64_t units);

  /// Whether the watch wants the work to end.
  bool stopped() const { return watch_.stopped && watch_.stopped(); }

  /// Throws Cancelled if the watch wants the work to end.
  void throw_if_stopped() const;

 private:
  void tell(std::int64_t done, bool ended);

  const Watch& watch_;
  std::string name_;
  std::int64_t total_;
  std::atomic<std::int64_t> done_{0};
  std::mutex telling_;
};

}  // namespace heightlight
