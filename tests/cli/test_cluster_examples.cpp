#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "command.h"
#include "folder_contents.h"
#include "scratch_folder.h"

// The scripts of examples/cluster, as a batch system and GNU parallel run them.

namespace heightlight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSmallStudy = R"({
  "maps": [{"shape": "cobbles", "size": 12}, {"shape": "steps", "size": 8}],
  "relief_shares": [0.1, 0.2, 0.4],
  "options": [{"rays": 16, "bounces": 3, "bins": 10}]
})";

/// A line of bash in the folder, with the command and the examples in the path; its exit code.
int run_bash(const ScratchFolder& folder, const std::string& line) {
  const fs::path command = HEIGHTLIGHT_COMMAND;
  write_text(folder / "line.sh", "PATH='" + command.parent_path().string() +
                                     "':'" HEIGHTLIGHT_SOURCE_DIR "/examples/cluster':$PATH\n" + line + '\n');
  const std::string bash =
      "cd '" + folder.path().string() + "' && bash line.sh > out.txt 2> error.txt < /dev/null";
  const int status = std::system(bash.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A study whose name needs quoting, and what one process makes of it.
void make_expected(const ScratchFolder& folder) {
  write_text(folder / "my study.json", kSmallStudy);
  const CommandResult whole = run_command("dataset 'my study.json' -o whole --quiet", folder);
  INFO(whole.error);
  REQUIRE(whole.exit_code == 0);
}

/// All but summaries, which tell the number of threads.
std::map<std::string, std::string> results_below(const fs::path& folder) {
  auto contents = folder_contents(folder);
  std::erase_if(contents, [](const auto& entry) { return entry.first.ends_with("summary.json"); });
  return contents;
}

void check_same_dataset(const ScratchFolder& folder) {
  INFO(read_text(folder / "error.txt"));
  CHECK((results_below(folder / "my study") == results_below(folder / "whole")));
}

}  // namespace

TEST_CASE("the tasks of an array of jobs make a dataset, each its shard", "[cli][dataset]") {
  const ScratchFolder folder;
  make_expected(folder);
  // What Slurm sets for `sbatch --array=1-3 --cpus-per-task=1 --mem=1G`.
  const int code = run_bash(folder, R"(set -e
    export SLURM_ARRAY_TASK_COUNT=3 SLURM_CPUS_PER_TASK=1 SLURM_MEM_PER_NODE=1024
    for task in 3 1 2; do
      SLURM_ARRAY_TASK_ID=$task slurm_dataset.sh 'my study.json' 'my study'
    done
    test ! -e 'my study/dataset.csv'
    heightlight dataset 'my study.json' -o 'my study' --merge)");
  CHECK(code == 0);
  check_same_dataset(folder);
  // An array that begins at 0 has no share for its first task.
  CHECK(run_bash(folder,
                 "SLURM_ARRAY_TASK_ID=0 SLURM_ARRAY_TASK_COUNT=3 SLURM_CPUS_PER_TASK=1 "
                 "SLURM_MEM_PER_NODE=1024 slurm_dataset.sh 'my study.json' 'my study'") == 2);
}

TEST_CASE("GNU parallel makes a dataset by several processes", "[cli][dataset]") {
  if (std::system("parallel --version 2> /dev/null | grep -q 'GNU parallel'") != 0) {
    WARN("SKIPPED: no GNU parallel here (scripts/install-packages --tests)");
    return;
  }
  const ScratchFolder folder;
  make_expected(folder);
  CHECK(run_bash(folder, "parallel_dataset.sh 'my study.json' 'my study' 3 500M") == 0);
  check_same_dataset(folder);
  // Where shards fail, the merge says what is missing.
  write_text(folder / "my study.json", R"({"maps": [{"file": "absent.png"}]})");
  CHECK(run_bash(folder, "parallel_dataset.sh 'my study.json' broken 2 500M") == 1);
  CHECK_THAT(read_text(folder / "error.txt"), Catch::Contains("broken: 1 of 1 runs are missing"));
}

}  // namespace heightlight
