#pragma once

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>

#include "core/interrupt.h"
#include "core/progress.h"

namespace heightlight {

/// Threads for parallel_for from now on; 0 means one per processor. Results never depend on it.
inline void set_thread_count(int threads) {
  omp_set_num_threads(threads > 0 ? threads : omp_get_num_procs());
}

inline int thread_count() { return omp_get_max_threads(); }

/// Calls body(i) once for each 0 ≤ i < count, in any order, on all threads. Bodies write to places of their
/// own, so that results are the same for any number of threads. The first exception stops the loop and is
/// thrown again here, as is Interrupted when a signal came.
template <class Body>
void parallel_for(std::int64_t count, Body&& body, Progress* progress = nullptr) {
  std::exception_ptr failure;
  std::atomic<bool> stop{false};
  // No more threads than there is work: those left over would only wait, and burn a processor meanwhile.
  const auto threads = static_cast<int>(std::clamp<std::int64_t>(count, 1, thread_count()));
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
  for (std::int64_t i = 0; i < count; ++i) {
    if (stop.load(std::memory_order_relaxed) || is_interrupted()) continue;
    try {
      body(i);
      if (progress) progress->add(1);
    } catch (...) {
#pragma omp critical(heightlight_parallel_failure)
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  }
  if (failure) std::rethrow_exception(failure);
  throw_if_interrupted();
}

}  // namespace heightlight
