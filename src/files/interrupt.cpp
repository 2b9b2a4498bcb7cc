#include "files/interrupt.h"

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

std::atomic<int> noted_signal_number{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
sem_t signal_came;

extern "C" void note_signal(int signal_number) {
  const int error_number = errno;
  noted_signal_number.store(signal_number);
  sem_post(&signal_came);
  errno = error_number;
}

/// A signal that the parent ignores stays ignored (nohup, background jobs of a shell).
void note_unless_ignored(int signal_number) {
  struct sigaction now {};
  sigaction(signal_number, nullptr, &now);
  if (now.sa_handler == SIG_IGN) return;
  struct sigaction noting {};
  noting.sa_handler = note_signal;
  noting.sa_flags = SA_RESTART;
  sigaction(signal_number, &noting, nullptr);
}

void wait_for_late_end(void (*when_late)(int)) {
  while (sem_wait(&signal_came) != 0) {
  }
  std::this_thread::sleep_for(kPatience);
  when_late(noted_signal_number.load());
}

}  // namespace

void note_interrupts(void (*when_late)(int signal_number)) {
  static bool is_noting = false;
  if (is_noting) return;
  is_noting = true;
  sem_init(&signal_came, 0, 0);
  std::thread(wait_for_late_end, when_late).detach();
  // Batch systems announce the end of a job's time by SIGUSR1, SIGUSR2 or SIGXCPU.
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT, SIGUSR1, SIGUSR2, SIGXCPU})
    note_unless_ignored(signal_number);
  std::signal(SIGCHLD, SIG_DFL);  // if the parent ignored it, nobody would learn how gnuplot ended
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond the limit then fails with an error
}

int noted_signal() { return noted_signal_number.load(std::memory_order_relaxed); }

void throw_if_interrupted() {
  if (noted_signal() != 0) throw Cancelled();
}

}  // namespace heightlight
