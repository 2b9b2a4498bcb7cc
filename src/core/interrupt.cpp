#include "core/interrupt.h"

#include <atomic>
#include <csignal>

#include "heightlight/error.h"

namespace heightlight {
namespace {

std::atomic<int> noted_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

// A second signal finds the default action again, so that nothing can make the program deaf.
extern "C" void note_signal(int signal_number) {
  noted_signal.store(signal_number);
  std::signal(signal_number, SIG_DFL);
}

}  // namespace

void note_interrupts() {
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

bool is_interrupted() { return noted_signal.load(std::memory_order_relaxed) != 0; }

void throw_if_interrupted() {
  if (const int signal_number = noted_signal.load(std::memory_order_relaxed))
    throw Interrupted(signal_number);
}

}  // namespace heightlight
