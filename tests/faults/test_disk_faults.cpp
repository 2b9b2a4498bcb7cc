#include <grp.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "base/hash.h"
#include "clean_failure.h"
#include "cli/folder_contents.h"

// Disks that fill up, folders that cannot be written to, inputs that vanish, names of all kinds: results
// appear whole or not at all.

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

const std::vector<std::string> kSimulate{"simulate", "map.png", "-o", "out", "--rays", "16", "--quiet"};

/// A file system in memory with room for so many bytes, where this process may mount one.
class SmallDisk {
 public:
  SmallDisk(const fs::path& folder, int bytes) : folder_(folder) {
    fs::create_directory(folder);
    const std::string size = "size=" + std::to_string(bytes);
    is_mounted_ = mount("none", folder.c_str(), "tmpfs", 0, size.c_str()) == 0;
    if (!is_mounted_) WARN("SKIPPED: no file system can be mounted here (not root?)");
  }
  ~SmallDisk() {
    if (is_mounted_) umount(folder_.c_str());
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  explicit operator bool() const { return is_mounted_; }

 private:
  fs::path folder_;
  bool is_mounted_ = false;
};

/// Root may write anywhere: be nobody.
void become_nobody() {
  if (geteuid() != 0) return;
  constexpr unsigned kNobody = 65534;
  if (setgroups(0, nullptr) != 0 || setgid(kNobody) != 0 || setuid(kNobody) != 0) _exit(126);
}

TEST_CASE("wherever a full disk stops it, simulate says so and leaves nothing", "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png");
  const int kibibytes = GENERATE(4, 48, 200, 4000);
  const SmallDisk disk(folder / "disk", kibibytes << 10);
  if (!disk) return;
  RunningCommand command({"simulate", "map.png", "-o", "disk/results/here", "--rays", "16", "--quiet"},
                         folder.path());
  const ProcessEnd end = command.wait();
  INFO(kibibytes << " KiB");
  if (end.exit_code == 0) {
    CHECK(kibibytes > 100);
    CHECK(fs::exists(folder / "disk/results/here/summary.json"));
    return;
  }
  CHECK(kibibytes < 4000);
  check_failed_cleanly(end, command.error_output(), folder / "disk", {});
  CHECK_THAT(command.error_output(), Contains("No space left on device") && Contains("disk/results/here"));
}

TEST_CASE("results too large for a file stop at any size, and leave nothing", "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png");
  const auto before = entries_below(folder.path());
  const auto bytes = GENERATE(rlim_t{2000}, rlim_t{5000}, rlim_t{30000});  // LLVM's OpenMP takes 1024
  RunningCommand command(kSimulate, folder.path(), [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  });
  const ProcessEnd end = command.wait();
  INFO(bytes);
  check_failed_cleanly(end, command.error_output(), folder.path(), before);
}

TEST_CASE("a dataset on a full disk stops at once, and goes on when there is room", "[faults]") {
  const ScratchFolder folder;
  write_text(folder / "study.json",
             R"({"maps": [{"shape": "fbm", "size": 16}], "relief_shares": [0.1, 0.2, 0.3],
                                        "options": [{"rays": 8, "bounces": 2, "bins": 4}]})");
  RunningCommand with_room({"dataset", "study.json", "-o", "whole", "--quiet"}, folder.path());
  REQUIRE(with_room.wait().exit_code == 0);
  const SmallDisk disk(folder / "disk", 500 << 10);
  if (!disk) return;
  const std::vector<std::string> words{"dataset", "study.json", "-o", "disk/out", "--quiet"};
  RunningCommand full(words, folder.path());
  CHECK(full.wait().exit_code == 1);
  const std::string error = full.error_output();
  CHECK_THAT(error, Contains("No space left on device") && Contains("disk/out/runs/fbm_16_1_relief0."));
  CHECK(std::count(error.begin(), error.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(folder / "disk/out/dataset.json"));
  REQUIRE(mount("none", (folder / "disk").c_str(), "tmpfs", MS_REMOUNT, "size=50m") == 0);
  RunningCommand again(words, folder.path());
  CHECK(again.wait().exit_code == 0);
  CHECK((folder_contents(folder / "disk/out") == folder_contents(folder / "whole")));
}

TEST_CASE("folders that cannot be written to are named, inputs that can only be read suffice", "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png");
  fs::permissions(folder / "map.png", fs::perms::owner_read | fs::perms::others_read);
  fs::permissions(folder.path(), fs::perms::all);
  fs::create_directory(folder / "locked");
  fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                         fs::perms::others_exec);
  fs::create_directory(folder / "free");
  fs::permissions(folder / "free", fs::perms::all);
  const auto before = entries_below(folder.path());
  for (const char* results : {"locked", "locked/new/one"}) {
    RunningCommand command({"simulate", "map.png", "-o", results, "--rays", "4"}, folder.path(),
                           become_nobody);
    const ProcessEnd end = command.wait();
    if (end.exit_code == 127 || end.exit_code == 126) {
      WARN("SKIPPED: the command cannot be run as another user");
      return;
    }
    check_failed_cleanly(end, command.error_output(), folder.path(), before);
    CHECK_THAT(command.error_output(), Contains(results) && Contains("Permission denied"));
  }
  RunningCommand synth({"synth", "flat", "-o", "locked/a.png"}, folder.path(), become_nobody);
  const ProcessEnd synth_end = synth.wait();
  check_failed_cleanly(synth_end, synth.error_output(), folder.path(), before);
  RunningCommand command({"simulate", "map.png", "-o", "free/out", "--rays", "4", "--quiet"}, folder.path(),
                         become_nobody);
  CHECK(command.wait().exit_code == 0);
  RunningCommand proc({"simulate", "map.png", "-o", "/proc/heightlight", "--rays", "4"}, folder.path());
  CHECK(proc.wait().exit_code == 1);
  CHECK_THAT(proc.error_output(), Contains("/proc/heightlight: cannot be written"));
}

TEST_CASE("a map removed, cut short or replaced while it is read gives whole results or an error",
          "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "kept.png", 300);
  write_text(folder / "text.png", "no picture");
  std::uint64_t random = 3;
  for (int i = 0; i < 9; ++i) {
    random = scramble(random);
    fs::copy_file(folder / "kept.png", folder / "map.png", fs::copy_options::overwrite_existing);
    const auto before = entries_below(folder.path());
    RunningCommand command({"info", "map.png"}, folder.path());
    std::this_thread::sleep_for(std::chrono::duration<double>(0.05 * unit_real(random)));
    if (i % 3 == 0) fs::remove(folder / "map.png");
    if (i % 3 == 1) fs::resize_file(folder / "map.png", 1000);
    if (i % 3 == 2) fs::rename(folder / "text.png", folder / "map.png");
    const ProcessEnd end = command.wait();
    if (i % 3 == 2) write_text(folder / "text.png", "no picture");
    INFO(command.error_output());
    CHECK((end.exit_code == 0 || end.exit_code == 1));
    if (end.exit_code == 1) {
      const std::string error = command.error_output();
      CHECK(std::count(error.begin(), error.end(), '\n') == 1);
      CHECK_THAT(error, Catch::StartsWith("heightlight: map.png: "));
    }
  }
}

TEST_CASE("inputs are never replaced by results", "[faults]") {
  const ScratchFolder folder;
  write_small_map(folder / "height.png");
  write_small_map(folder / "ambient_occlusion.png");
  fs::create_symlink("height.png", folder / "linked.png");
  const auto before = folder_contents(folder.path());
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"simulate", "height.png", "-o", "."},
           {"simulate", "./height.png", "-o", folder.path().string()},
           {"simulate", "linked.png", "-o", ".", "--albedo", "ambient_occlusion.png"}}) {
    RunningCommand command(words, folder.path());
    CHECK(command.wait().exit_code == 2);
    CHECK_THAT(command.error_output(), Contains("the results would replace it"));
    CHECK((folder_contents(folder.path()) == before));
  }
}

TEST_CASE("names with spaces, letters of any alphabet, quotes and bytes that are no text are only names",
          "[faults]") {
  const std::string name = GENERATE("a b.png", "Höhe ∂ 高さ.png", "it's \"so\".png", "new\nline.png",
                                    "50%s.png", "latin \xe4.png", "-x.png");
  const ScratchFolder folder;
  write_small_map(folder / name);
  RunningCommand command({"simulate", "./" + name, "-o", "results of " + name, "--rays", "4", "--quiet"},
                         folder.path());
  const ProcessEnd end = command.wait();
  INFO(name << ": " << command.error_output());
  REQUIRE(end.exit_code == 0);
  const fs::path results = folder / ("results of " + name);
  CHECK(nlohmann::json::accept(read_text(results / "summary.json")));
  CHECK(fs::file_size(results / "curves.png") > 0);
}

}  // namespace
}  // namespace heightlight
