#include <fmt/core.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/hash.h"
#include "cli/shard.h"
#include "command.h"
#include "files/lock_file.h"
#include "folder_contents.h"
#include "heightlight/error.h"
#include "running_command.h"

// A dataset made by several processes: in one folder, with shards and without, and in folders of their own.

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;
using Words = std::vector<std::string>;

/// Four runs, by rays and by walks.
constexpr const char* kSharedManifest = R"({
  "maps": [{"shape": "cobbles", "size": 16, "seed": 2}, {"shape": "steps", "size": 12, "name": "stairs"}],
  "relief_shares": [0.1],
  "options": [{"name": "cast", "rays": 16, "bounces": 3, "bins": 10},
              {"name": "walked", "error": 0.02, "bounces": 3, "bins": 10}]
})";

Words dataset_words(const std::string& folder, const Words& more = {}) {
  Words words{"dataset", "study.json", "-o", folder, "--quiet", "--threads", "1"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

void run_dataset(const ScratchFolder& folder, const Words& words) {
  RunningCommand command(words, folder.path());
  const ProcessEnd end = command.wait();
  INFO(command.error_output());
  REQUIRE(end.exit_code == 0);
  CHECK(has_only_warnings(command.error_output()));
}

/// Beside `study.json`, `whole`: what one undisturbed process makes of it.
void make_whole_dataset(const ScratchFolder& folder, const std::string& manifest = kSharedManifest) {
  write_text(folder / "study.json", manifest);
  run_dataset(folder, dataset_words("whole"));
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

void check_same_tables(const ScratchFolder& folder, const std::string& made) {
  for (const char* table : {"dataset.csv", "dataset.json"}) {
    const std::string whole = read_text(folder / ("whole/" + std::string(table)));
    CHECK_FALSE(whole.empty());
    CHECK((read_text(folder / (made + '/' + table)) == whole));
  }
}

/// Of the four runs.
void wait_for_all_but_one(const fs::path& runs) {
  const auto is_run = [](const std::string& name) { return name.front() != '.'; };
  for (std::ptrdiff_t done = 0; done < 3;) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const std::set<std::string> names = names_in(runs);
    done = std::count_if(names.begin(), names.end(), is_run);
  }
}

/// From now on the system answers this process as a file system without locks does.
void forbid_locks() {
  std::array filter{
      sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_flock, 0, 1),
      sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | ENOLCK),
      sock_filter BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{.len = filter.size(), .filter = filter.data()};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    _exit(126);
}

}  // namespace

TEST_CASE("a run has one shard of any count, by its key alone", "[cli][dataset]") {
  const std::uint64_t count = GENERATE(1, 2, 3, 7, 1000);
  std::uint64_t random = count;
  for (int i = 0; i < 100; ++i) {
    random = scramble(random);
    const std::string key = fmt::format("{:016x}{:048x}", random, i);
    std::uint64_t holders = 0;
    for (std::uint64_t k = 1; k <= count; ++k) holders += has_run({.number = k, .count = count}, key) ? 1 : 0;
    CHECK(holders == 1);
    CHECK(has_run({.number = random % count + 1, .count = count}, key));
  }
  CHECK(has_run({.number = count, .count = count}, ""));
}

TEST_CASE("shards together do every run, and merged they are the tables of one process", "[cli][dataset]") {
  const ScratchFolder folder;
  make_whole_dataset(folder);
  for (const char* shard : {"1/3", "2/3", "3/3"})
    run_dataset(folder, dataset_words("shared", {"--shard", shard}));
  CHECK((names_in(folder / "shared/runs") == names_in(folder / "whole/runs")));
  CHECK_FALSE(fs::exists(folder / "shared/dataset.csv"));
  run_dataset(folder, dataset_words("shared", {"--merge"}));
  CHECK((folder_contents(folder / "shared") == folder_contents(folder / "whole")));
  const std::string costs = read_text(folder / "shared/costs.csv");
  run_dataset(folder, dataset_words("shared", {"--merge"}));
  CHECK((folder_contents(folder / "shared") == folder_contents(folder / "whole")));
  CHECK((read_text(folder / "shared/costs.csv") == costs));
}

TEST_CASE("a run that another process is busy with waits for it, and the others do not",
          "[cli][dataset][slow]") {
  const ScratchFolder folder;
  make_whole_dataset(folder);
  const std::string busy = *names_in(folder / "whole/runs").begin();
  fs::create_directories(folder / "out/runs");
  auto lock = LockFile::try_take(folder / ("out/runs/." + busy + ".lock"));
  REQUIRE(lock);
  RunningCommand command(dataset_words("out"), folder.path());
  wait_for_all_but_one(folder / "out/runs");
  CHECK_FALSE(fs::exists(folder / "out/runs" / busy));
  const bool is_done_by_other = GENERATE(true, false);
  if (is_done_by_other) {
    fs::copy(folder / "whole/runs" / busy, folder / "out/runs" / busy);
    const std::string summary = read_text(folder / "whole/runs" / busy / "summary.json");
    lock.reset();
    CHECK(command.wait().exit_code == 0);
    // The times inside tell who made it.
    CHECK((read_text(folder / "out/runs" / busy / "summary.json") == summary));
  } else {
    lock.reset();
    CHECK(command.wait().exit_code == 0);
  }
  CHECK((folder_contents(folder / "out") == folder_contents(folder / "whole")));
}

TEST_CASE("a process that waits for another heeds signals", "[cli][dataset][slow]") {
  const ScratchFolder folder;
  make_whole_dataset(folder);
  fs::create_directories(folder / "out/runs");
  const std::string busy = *names_in(folder / "whole/runs").begin();
  const auto lock = LockFile::try_take(folder / ("out/runs/." + busy + ".lock"));
  RunningCommand command(dataset_words("out"), folder.path());
  wait_for_all_but_one(folder / "out/runs");
  const ProcessEnd end = command.interrupt_after(0.3, SIGTERM);
  CHECK(end.exit_code == 128 + SIGTERM);
  CHECK_THAT(command.error_output(), Catch::EndsWith("heightlight: interrupted\n"));
  CHECK_FALSE(fs::exists(folder / "out/dataset.csv"));
}

TEST_CASE("where a file system knows no locks, work is done twice, and the results are the same",
          "[cli][dataset][slow]") {
  const ScratchFolder folder;
  make_whole_dataset(folder);
  RunningCommand one(dataset_words("out"), folder.path(), forbid_locks);
  RunningCommand two(dataset_words("out"), folder.path(), forbid_locks);
  CHECK(one.wait().exit_code == 0);
  CHECK(two.wait().exit_code == 0);
  INFO(one.error_output() << two.error_output());
  run_dataset(folder, dataset_words("out"));
  CHECK((folder_contents(folder / "out") == folder_contents(folder / "whole")));
}

TEST_CASE("what killed processes left goes away, and hidden files of others stay", "[cli][dataset]") {
  const ScratchFolder folder;
  make_whole_dataset(folder);
  const fs::path runs = folder / "whole/runs";
  write_text(runs / ".gone_relief0.1-0123456789ab.lock", "");
  write_text(runs / ".noted-0123456789ab.lock", "not empty");
  write_text(runs / ".mine.lock", "");
  const auto held = LockFile::try_take(runs / ".held-0123456789ab.lock");
  run_dataset(folder, dataset_words("whole"));
  CHECK_FALSE(fs::exists(runs / ".gone_relief0.1-0123456789ab.lock"));
  CHECK(fs::exists(runs / ".noted-0123456789ab.lock"));
  CHECK(fs::exists(runs / ".mine.lock"));
  CHECK(fs::exists(runs / ".held-0123456789ab.lock"));
}

TEST_CASE("runs in folders of their own are merged into a new one", "[cli][dataset][slow]") {
  const ScratchFolder folder;
  make_whole_dataset(folder);
  run_dataset(folder, dataset_words("here", {"--shard", "1/2"}));
  run_dataset(folder, dataset_words("there", {"--shard", "2/2"}));
  const auto here = folder_contents(folder / "here");
  const auto there = folder_contents(folder / "there");

  const CommandResult half = run_command("dataset study.json here -o all --merge", folder);
  CHECK(half.exit_code == 1);
  const std::string missing = std::to_string(names_in(folder / "there/runs").size());
  CHECK_THAT(half.error,
             Catch::StartsWith("heightlight: all: " + missing + " of 4 runs are missing, and no tables") &&
                 Contains(*names_in(folder / "there/runs").begin()));
  CHECK(std::count(half.error.begin(), half.error.end(), '\n') == 1);
  CHECK_FALSE(fs::exists(folder / "all"));

  // As told, under another name: what the manifest holds matters.
  fs::create_directory(folder / "elsewhere");
  fs::rename(folder / "study.json", folder / "elsewhere/study.json");
  for (int times = 0; times < 2; ++times) {
    const CommandResult merged =
        run_command("dataset --merge elsewhere/study.json here there -o all", folder);
    INFO(merged.error);
    CHECK(merged.exit_code == 0);
    CHECK_THAT(merged.out, Contains(times == 0 ? "4 of them taken in" : " 0 of them taken in"));
    check_same_tables(folder, "all");
    auto expected = folder_contents(folder / "whole");
    std::erase_if(expected, [](const auto& entry) { return entry.first.starts_with("maps"); });
    CHECK((folder_contents(folder / "all") == expected));
  }
  CHECK((folder_contents(folder / "here") == here));
  CHECK((folder_contents(folder / "there") == there));
}

TEST_CASE("a damaged run is missing where it is merged", "[cli][dataset]") {
  const ScratchFolder folder;
  make_whole_dataset(folder);
  const auto tables = folder_contents(folder / "whole");
  const std::string damaged = *names_in(folder / "whole/runs").begin();
  write_text(folder / "whole/runs" / damaged / "curves.csv", "cut sho");
  const CommandResult result = run_command("dataset study.json -o whole --merge", folder);
  CHECK(result.exit_code == 1);
  CHECK(result.error ==
        "heightlight: whole: 1 of 4 runs are missing, and no tables are written: " + damaged + "\n");
  run_dataset(folder, dataset_words("whole", {"--shard", "1/1"}));
  CHECK((folder_contents(folder / "whole") == tables));
}

TEST_CASE("a folder of another version, manifest or kind is not merged", "[cli][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "study.json", R"({"maps": [{"shape": "flat", "size": 4}], "options": [{"rays": 4}]})");
  run_dataset(folder, dataset_words("made", {"--shard", "1/1"}));
  const std::string origin = read_text(folder / "made/origin.json");
  const auto [fault, message] = GENERATE(
      std::pair{"version", "made: was made by version \"old\", but this is version "},
      std::pair{"manifest", "made: was made from a manifest other than the current study.json"},
      std::pair{"unknown", "made: is not the folder of a dataset: it has no origin.json"},
      std::pair{"damaged", "made/origin.json: parse error"},
      std::pair{"odd", "made: was made by version \"\""}, std::pair{"absent", "made: no such folder"});
  const std::string what = fault;
  nlohmann::json changed = nlohmann::json::parse(origin);
  changed["version"] = "old";
  if (what == "version") write_text(folder / "made/origin.json", changed.dump());
  if (what == "manifest") write_text(folder / "study.json", kSharedManifest);
  if (what == "unknown") fs::remove(folder / "made/origin.json");
  if (what == "damaged") write_text(folder / "made/origin.json", "{");
  if (what == "odd") write_text(folder / "made/origin.json", "[1]");
  if (what == "absent") fs::remove_all(folder / "made");
  const auto before = folder_contents(folder.path());
  for (const char* arguments :
       {"dataset study.json -o made --merge", "dataset study.json made -o new --merge"}) {
    const CommandResult result = run_command(arguments, folder);
    CHECK(result.exit_code == 1);
    CHECK_THAT(result.error, Catch::StartsWith("heightlight: " + std::string(message)));
    CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
    CHECK((folder_contents(folder.path()) == before));
  }
}

TEST_CASE("shards and merges that make no sense are wrong usage", "[cli][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "study.json", kSharedManifest);
  const auto [arguments, message] = GENERATE(
      std::pair{"--shard 0/4", "--shard 0/4: must be K/N"},
      std::pair{"--shard 5/4", "--shard 5/4: must be K/N"},
      std::pair{"--shard x/4", "--shard x/4: must be K/N"}, std::pair{"--shard 3", "--shard 3: must be K/N"},
      std::pair{"--shard 1/2/3", "--shard 1/2/3: must be K/N"},
      std::pair{"--shard -1/4", "--shard -1/4: must be K/N"},
      std::pair{"--shard 1/99999999999999999999", "must be K/N"},
      std::pair{"--shard 1/4 --merge", "--shard 1/4: cannot be combined with --merge"},
      std::pair{"elsewhere", "elsewhere: runs of other folders can only be taken in with --merge"});
  const CommandResult result = run_command("dataset study.json -o out " + std::string(arguments), folder);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.error, Catch::StartsWith("heightlight: ") && Contains(message));
  CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a run that fails is told by its shard, is missing in a merge, and comes to the tables without one",
          "[cli][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "broken.png", "no picture");
  write_text(folder / "study.json",
             R"({"maps": [{"file": "absent.png"}, {"file": "broken.png"}, {"shape": "flat", "size": 4}],
                 "options": [{"rays": 4}]})");
  const CommandResult alone = run_command("dataset study.json -o whole --quiet", folder);
  CHECK(alone.exit_code == 1);
  const CommandResult shard = run_command("dataset study.json -o shared --quiet --shard 1/1", folder);
  CHECK(shard.exit_code == 1);
  CHECK(shard.error == alone.error);
  const CommandResult merged = run_command("dataset study.json -o shared --merge", folder);
  CHECK(merged.exit_code == 1);
  CHECK_THAT(merged.error, Contains("absent.png: no such file\n") &&
                               Contains("shared: 2 of 3 runs are missing") && Contains(": absent, broken-"));
  CHECK_FALSE(fs::exists(folder / "shared/dataset.json"));
  CHECK(run_command("dataset study.json -o shared --quiet", folder).exit_code == 1);
  CHECK((folder_contents(folder / "shared") == folder_contents(folder / "whole")));
}

namespace {

/// Of twice as many runs.
double seconds_of_whole_dataset(const ScratchFolder& folder) {
  std::string manifest = kSharedManifest;
  manifest.replace(manifest.find("[0.1]"), 5, "[0.1, 0.3]");
  const auto start = std::chrono::steady_clock::now();
  make_whole_dataset(folder, manifest);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Two processes at work in one folder, each begun again when it was killed.
struct TwoProcesses {
  const ScratchFolder& folder;
  std::array<Words, 2> words;
  std::array<std::unique_ptr<RunningCommand>, 2> running = {};
  int kills = 0;

  void start(std::size_t i) { running[i] = std::make_unique<RunningCommand>(words[i], folder.path()); }

  /// Whether it had not ended by itself before.
  bool kill_after(std::size_t i, double seconds) {
    const ProcessEnd end = running[i]->interrupt_after(seconds, SIGKILL);
    INFO(running[i]->error_output());
    REQUIRE((end.signal == SIGKILL || end.exit_code == 0));
    running[i].reset();
    kills += end.signal == SIGKILL ? 1 : 0;
    return end.signal == SIGKILL;
  }

  /// Lets those that are at work come to their end.
  void finish() {
    for (auto& command : running) {
      if (!command) continue;
      const ProcessEnd end = command->wait();
      INFO(command->error_output());
      REQUIRE(end.exit_code == 0);
      command.reset();
    }
  }
};

}  // namespace

TEST_CASE("two processes in one dataset, killed at random moments and begun again, make the tables of one",
          "[cli][dataset][slow]") {
  const bool by_shards = GENERATE(true, false);
  const ScratchFolder folder;
  const double seconds = seconds_of_whole_dataset(folder);
  const auto expected = folder_contents(folder / "whole");
  TwoProcesses two{.folder = folder, .words = {dataset_words("killed"), dataset_words("killed")}};
  if (by_shards)
    two.words = {dataset_words("killed", {"--shard", "1/2"}), dataset_words("killed", {"--shard", "2/2"})};

  constexpr int kKills = 12;
  std::uint64_t random = by_shards ? 1 : 2;
  while (two.kills < kKills) {
    std::array ended{false, false};
    two.start(0);
    two.start(1);
    while (!(ended[0] && ended[1])) {
      random = scramble(random);
      const std::size_t i = ended[0] || (!ended[1] && random % 2 == 1) ? 1 : 0;
      if (two.kills >= kKills) break;
      ended[i] = !two.kill_after(i, unit_real(scramble(random)) * seconds / 2);
      if (!ended[i]) two.start(i);
    }
    two.finish();
    if (by_shards) run_dataset(folder, dataset_words("killed", {"--merge"}));
    check_same_tables(folder, "killed");
    CHECK((folder_contents(folder / "killed") == expected));
    fs::remove_all(folder / "killed");
  }
}

}  // namespace heightlight
