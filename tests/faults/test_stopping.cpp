#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include "base/hash.h"
#include "clean_failure.h"
#include "cli/folder_contents.h"

// Stopped, killed or short of memory at any moment, the command leaves nothing half-written.

namespace heightlight {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kLongSimulate{"simulate", "map.png", "-o", "out", "--rays", "64", "--quiet"};

double seconds_of_one_run(const ScratchFolder& folder) {
  const auto start = std::chrono::steady_clock::now();
  RunningCommand command(kLongSimulate, folder.path());
  REQUIRE(command.wait().exit_code == 0);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Until the command is at work: beside its map there is something.
void wait_for_staging(const ScratchFolder& folder) {
  while (folder.entry_count() < 2) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST_CASE("SIGINT and SIGTERM at random moments end it soon, and leave nothing", "[faults][slow]") {
  const int signal = GENERATE(SIGINT, SIGTERM);
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 96);
  const auto before = entries_below(folder.path());
  const double whole = seconds_of_one_run(folder);
  std::uint64_t random = static_cast<std::uint64_t>(signal);
  for (int i = 0; i < 5; ++i) {
    fs::remove_all(folder / "out");
    random = scramble(random);
    RunningCommand command(kLongSimulate, folder.path());
    std::this_thread::sleep_for(std::chrono::duration<double>(whole * unit_real(random)));
    const auto sent = std::chrono::steady_clock::now();
    command.send(signal);
    const ProcessEnd end = command.wait();
    const std::chrono::duration<double> late = std::chrono::steady_clock::now() - sent;
    if (late.count() > 1) WARN("took " << late.count() << " s to end, on a machine that may be busy");
    CHECK(late.count() < 5);  // far from the second that is promised: what hangs, hangs for longer
    if (end.exit_code == 0) continue;
    if (end.signal != 0) CHECK(end.signal == signal);  // it had not begun yet
    if (end.signal == 0) CHECK(end.exit_code == 128 + signal);
    CHECK((entries_below(folder.path()) == before));
  }
}

TEST_CASE("a second signal does not cut the tidying short", "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 64);
  const auto before = entries_below(folder.path());
  RunningCommand command({"simulate", "map.png", "-o", "out", "--rays", "65536", "--quiet"}, folder.path());
  wait_for_staging(folder);
  for (int i = 0; i < 3; ++i) command.send(SIGINT);
  CHECK(command.wait().exit_code == 130);
  CHECK((entries_below(folder.path()) == before));
}

TEST_CASE("killed at random moments, simulate leaves whole results or none, and the next run tidies up",
          "[faults][slow]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 64);
  const double whole = seconds_of_one_run(folder);
  const auto results = folder_contents(folder / "out");
  std::uint64_t random = 9;
  for (int i = 0; i < 8; ++i) {
    fs::remove_all(folder / "out");
    random = scramble(random);
    RunningCommand command(kLongSimulate, folder.path());
    command.interrupt_after(whole * unit_real(random), SIGKILL);
    if (fs::exists(folder / "out")) CHECK((folder_contents(folder / "out") == results));
    for (const auto& entry : fs::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename().string();
      CHECK((name == "map.png" || name == "out" || name.starts_with(".heightlight-")));
    }
  }
  fs::remove_all(folder / "out");
  RunningCommand last(kLongSimulate, folder.path());
  REQUIRE(last.wait().exit_code == 0);
  CHECK((folder_contents(folder / "out") == results));
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 2);  // map.png, out
}

TEST_CASE("staging folders of processes that live are left alone", "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 64);
  RunningCommand longer({"simulate", "map.png", "-o", "longer", "--rays", "2048", "--quiet"}, folder.path());
  wait_for_staging(folder);
  RunningCommand shorter({"simulate", "map.png", "-o", "shorter", "--rays", "4", "--quiet"}, folder.path());
  CHECK(shorter.wait().exit_code == 0);
  CHECK(longer.wait().exit_code == 0);
  CHECK(fs::exists(folder / "longer/summary.json"));
  CHECK(fs::exists(folder / "shorter/summary.json"));
}

TEST_CASE("whatever --memory allows, simulate does it or says how much it needs", "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 40);
  const auto before = entries_below(folder.path());
  const std::string allowed = GENERATE("1", "4M", "160M", "500M");
  const std::string method = GENERATE("rays", "horizon");
  RunningCommand command(
      {"simulate", "map.png", "-o", "out", "--visibility", method, "--memory", allowed, "--quiet"},
      folder.path());
  const ProcessEnd end = command.wait();
  INFO(allowed << ", " << method);
  if (end.exit_code == 0) return;
  check_failed_cleanly(end, command.error_output(), folder.path(), before);
  CHECK_THAT(command.error_output(), Catch::Contains("--memory"));
}

#ifndef HEIGHTLIGHT_SANITIZED  // which takes more addresses than any limit leaves
void limit_addresses(rlim_t mebibytes) {
  const rlimit limit{mebibytes << 20, mebibytes << 20};
  setrlimit(RLIMIT_AS, &limit);
}

TEST_CASE("short of memory, simulate fails with one line and leaves nothing", "[faults][slow]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 64);
  rlim_t least = 64;  // with which the program starts at all
  for (;; least += 16) {
    RunningCommand version({"--version"}, folder.path(), [&] { limit_addresses(least); });
    if (version.wait().exit_code == 0) break;
  }
  const auto before = entries_below(folder.path());
  int failed = 0;
  for (rlim_t more = 0; more < 480; more += 60) {
    fs::remove_all(folder / "out");
    RunningCommand command(kLongSimulate, folder.path(), [&] { limit_addresses(least + more); });
    const ProcessEnd end = command.wait();
    INFO(least + more << " MiB, " << end.exit_code << ", signal " << end.signal);
    if (end.exit_code == 0) continue;
    ++failed;
    if (command.error_output().find("libgomp: Thread creation failed") != std::string::npos) {
      CHECK(end.exit_code == 1);  // OpenMP's own line, which ends the process
      CHECK((entries_below(folder.path()) == before));
    } else {
      check_failed_cleanly(end, command.error_output(), folder.path(), before);
    }
  }
  CHECK(failed > 0);
}
#endif

}  // namespace
}  // namespace heightlight
