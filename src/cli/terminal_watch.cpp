#include "cli/terminal_watch.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <vector>

#include "files/interrupt.h"

namespace heightlight {
namespace {

using Clock = std::chrono::steady_clock;

/// The bars of steps that are at work, the innermost last. Only that one is drawn.
class TerminalBars {
 public:
  explicit TerminalBars(std::string context) : context_(std::move(context)) {}

  void tell(const Step& step) {
    const std::lock_guard lock(mutex_);
    if (step.ended) {
      end(step.name);
    } else if (step.done == 0) {
      bars_.push_back({.name = std::string(step.name)});
    } else if (!bars_.empty() && bars_.back().name == step.name) {
      draw(bars_.back(), step);
    }
  }

 private:
  struct Bar {
    std::string name;
    Clock::time_point start = Clock::now();
    Clock::time_point due = start + std::chrono::seconds(1);
    bool drawn = false;
  };

  void end(std::string_view name) {
    if (bars_.empty() || bars_.back().name != name) return;
    if (bars_.back().drawn) std::fputs("\r\033[K", stderr);
    bars_.pop_back();
  }

  void draw(Bar& bar, const Step& step) const {
    const Clock::time_point now = Clock::now();
    if (now < bar.due) return;
    bar.due = now + std::chrono::milliseconds(200);
    bar.drawn = true;
    const double seconds = std::chrono::duration<double>(now - bar.start).count();
    if (step.total <= 0) {
      fmt::print(stderr, "\r{}{} … {:.0f} s \033[K", context_, bar.name, seconds);
    } else {
      constexpr int kWidth = 30;
      const double share = std::min(1.0, static_cast<double>(step.done) / static_cast<double>(step.total));
      const std::string filled(static_cast<std::size_t>(share * kWidth), '=');
      fmt::print(stderr, "\r{}{} [{:<{}}] {:3.0f} %  {:.0f} s left \033[K", context_, bar.name, filled,
                 kWidth, share * 100, seconds * (1 - share) / share);
    }
    std::fflush(stderr);
  }

  std::string context_;
  std::mutex mutex_;
  std::vector<Bar> bars_;
};

}  // namespace

Watch terminal_watch(bool quiet, const std::string& context) {
  Watch watch;
  watch.stopped = [] { return noted_signal() != 0; };
  if (quiet || isatty(STDERR_FILENO) != 1) return watch;
  watch.tell = [bars = std::make_shared<TerminalBars>(context)](const Step& step) { bars->tell(step); };
  return watch;
}

}  // namespace heightlight
