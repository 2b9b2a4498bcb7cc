#include "core/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace heightlight {
namespace {

std::string bar_context;  // set between works, not during one

}  // namespace

void Progress::set_context(std::string context) { bar_context = std::move(context); }

Progress::Progress(std::string label, std::int64_t total, bool quiet)
    : label_(bar_context + std::move(label)),
      total_(total),
      draws_(!quiet && isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void Progress::add(std::int64_t units) {
  const std::int64_t done = done_.fetch_add(units, std::memory_order_relaxed) + units;
  if (!draws_) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  const auto milliseconds = static_cast<std::int64_t>(elapsed.count() * 1000);
  std::int64_t due = next_draw_ms_.load(std::memory_order_relaxed);
  // One thread wins the right to draw; the others go on with their work.
  if (milliseconds < due || !next_draw_ms_.compare_exchange_strong(due, milliseconds + 200)) return;
  draw(elapsed.count(), done);
}

void Progress::draw(double seconds, std::int64_t done) {
  drawn_ = true;
  if (total_ <= 0) {
    std::fprintf(stderr, "\r%s … %.0f s \033[K", label_.c_str(), seconds);
    std::fflush(stderr);
    return;
  }
  constexpr int kWidth = 30;
  const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total_));
  const double left = share > 0 ? seconds * (1 - share) / share : 0;
  const int filled = static_cast<int>(share * kWidth);
  std::string bar(static_cast<std::size_t>(filled), '=');
  bar.resize(kWidth, ' ');
  std::fprintf(stderr, "\r%s [%s] %3.0f %%  %.0f s left \033[K", label_.c_str(), bar.c_str(), share * 100,
               left);
  std::fflush(stderr);
}

}  // namespace heightlight
