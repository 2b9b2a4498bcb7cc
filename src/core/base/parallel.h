#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>

#include "base/progress.h"

namespace heightlight {

/// Threads that parallel_for uses when it is called from this thread. OpenMP keeps that number for each
/// thread that calls it, so that two callers do not disturb each other.
inline int thread_count() { return omp_get_max_threads(); }

/// Sets the number of threads for as long as this object lives. Results never depend on it.
class ThreadScope {
 public:
  /// 0 leaves the number as it is.
  explicit ThreadScope(int threads) : before_(thread_count()) {
    if (threads > 0) omp_set_num_threads(threads);
  }
  ~ThreadScope() { omp_set_num_threads(before_); }
  ThreadScope(const ThreadScope&) = delete;
  ThreadScope& operator=(const ThreadScope&) = delete;

 private:
  int before_;
};

/// Calls body(i) once for each 0 ≤ i < count, in any order, on all threads. Each call writes to places of its
/// own, so that results are the same for any number of threads. The first exception stops the loop and is
/// thrown again here. If `progress` is given, each finished i is reported to it, and its watch may end the
/// loop: then this function throws Cancelled.
template <class Body>
void parallel_for(std::int64_t count, Body&& body, Progress* progress = nullptr) {
  std::exception_ptr failure;
  std::atomic<bool> stop{false};
  // No more threads than there is work: the others would only wait, and burn a processor meanwhile.
  const auto threads = static_cast<int>(std::clamp<std::int64_t>(count, 1, thread_count()));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i) {
    if (stop.load(std::memory_order_relaxed)) continue;
    try {
      if (progress) progress->throw_if_stopped();
      body(i);
      if (progress) progress->add(1);
    } catch (...) {
#pragma omp critical(heightlight_parallel_failure)
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace heightlight
