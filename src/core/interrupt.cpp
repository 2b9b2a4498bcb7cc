#include "core/interrupt.h"

#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>

#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr std::chrono::milliseconds kPatience{700};

std::atomic<int> noted_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
sem_t signal_came;

extern "C" void note_signal(int signal_number) {
  const int error_number = errno;
  noted_signal.store(signal_number);
  sem_post(&signal_came);
  errno = error_number;
}

void wait_for_late_end(void (*when_late)(int)) {
  while (sem_wait(&signal_came) != 0) {
  }
  std::this_thread::sleep_for(kPatience);
  when_late(noted_signal.load());
}

}  // namespace

void note_interrupts(void (*when_late)(int signal_number)) {
  static bool is_noting = false;
  if (is_noting) return;
  is_noting = true;
  sem_init(&signal_came, 0, 0);
  std::thread(wait_for_late_end, when_late).detach();
  std::signal(SIGINT, note_signal);
  std::signal(SIGTERM, note_signal);
}

bool is_interrupted() { return noted_signal.load(std::memory_order_relaxed) != 0; }

void throw_if_interrupted() {
  if (const int signal_number = noted_signal.load(std::memory_order_relaxed))
    throw Interrupted(signal_number);
}

}  // namespace heightlight
