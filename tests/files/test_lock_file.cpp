#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "files/lock_file.h"
#include "heightlight/error.h"
#include "scratch_folder.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

TEST_CASE("a lock is one holder's, and its file is there as long as it is held", "[files][lock]") {
  const ScratchFolder folder;
  const fs::path path = folder / ".run.lock";
  {
    const auto lock = LockFile::try_take(path);
    REQUIRE(lock);
    CHECK(fs::exists(path));
    CHECK_FALSE(LockFile::try_take(path));
    CHECK(LockFile::try_take(folder / ".other.lock"));
    CHECK(fs::exists(path));
  }
  CHECK(folder.entry_count() == 0);
  CHECK(LockFile::try_take(path));
}

TEST_CASE("a lock outlives no process, and what a killed one left is taken", "[files][lock]") {
  const ScratchFolder folder;
  const fs::path path = folder / ".run.lock";
  const pid_t process = fork();
  if (process == 0) {
    const auto lock = LockFile::try_take(path);
    write_text(folder / "held", "");
    for (;;) pause();
  }
  while (!fs::exists(folder / "held")) std::this_thread::yield();
  CHECK_FALSE(LockFile::try_take(path));
  kill(process, SIGKILL);
  waitpid(process, nullptr, 0);
  CHECK(fs::exists(path));
  CHECK(LockFile::take(path));
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE("no two hold a lock at once, though its file comes and goes", "[files][lock]") {
  const ScratchFolder folder;
  const fs::path path = folder / ".run.lock";
  std::atomic<int> holders{0};
  std::atomic<int> most{0};
  std::atomic<int> taken{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      while (taken < 400) {
        const auto lock = LockFile::try_take(path);
        if (!lock) continue;
        const int now = ++holders;
        for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
        }
        std::this_thread::yield();
        ++taken;
        --holders;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(most == 1);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("a lock that cannot be made names its path", "[files][lock]") {
  const ScratchFolder folder;
  fs::create_directory_symlink("elsewhere", folder / "link");
  CHECK_THROWS_AS(LockFile::try_take(folder / "absent/lock"), OutputError);
  CHECK_THROWS_AS(LockFile::try_take(folder / "link"), OutputError);
  CHECK_FALSE(fs::exists(folder / "elsewhere"));
}

}  // namespace
}  // namespace heightlight
