#include "base/progress.h"

#include "heightlight/error.h"

namespace heightlight {

Progress::Progress(std::string name, std::int64_t total, const Watch& watch)
    : watch_(watch), name_(std::move(name)), total_(total) {
  if (watch_.tell) tell(0, false);
}

Progress::~Progress() {
  if (watch_.tell) tell(done_.load(), true);
}

void Progress::add(std::int64_t units) {
  const std::int64_t done = done_.fetch_add(units, std::memory_order_relaxed) + units;
  if (!watch_.tell) return;
  // One thread reports; the others go on with their work.
  const std::unique_lock lock(telling_, std::try_to_lock);
  if (lock) tell(done, false);
}

void Progress::throw_if_stopped() const {
  if (stopped()) throw Cancelled();
}

void Progress::tell(std::int64_t done, bool ended) {
  watch_.tell({.name = name_, .done = done, .total = total_, .ended = ended});
}

}  // namespace heightlight
