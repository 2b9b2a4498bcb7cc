// How many threads work where nobody says: OMP_NUM_THREADS, or else the process's affinity.

#include <sched.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "results.h"
#include "running_command.h"

namespace heightlight {
namespace {

int threads_used(const std::vector<std::string>& more, const std::function<void()>& prepare) {
  const ScratchFolder folder;
  RunningCommand synth({"synth", "fbm", "-o", "map.png", "--size", "16"}, folder.path());
  REQUIRE(synth.wait().exit_code == 0);
  std::vector<std::string> words{"simulate", "map.png", "-o", "out", "--bounces", "1", "--quiet"};
  words.insert(words.end(), more.begin(), more.end());
  RunningCommand command(words, folder.path(), prepare);
  REQUIRE(command.wait().exit_code == 0);
  return nlohmann::json::parse(read_text(folder / "out/summary.json"))["threads"].get<int>();
}

void stay_on_one_processor() {
  unsetenv("OMP_NUM_THREADS");
  cpu_set_t all;
  sched_getaffinity(0, sizeof all, &all);
  int first = 0;
  while (!CPU_ISSET(first, &all)) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  sched_setaffinity(0, sizeof one, &one);
}

}  // namespace

TEST_CASE("without --threads, OMP_NUM_THREADS counts, or else the affinity", "[cli]") {
  const auto three = [] { setenv("OMP_NUM_THREADS", "3", 1); };
  CHECK(threads_used({}, three) == 3);
  CHECK(threads_used({"--threads", "2"}, three) == 2);
  CHECK(threads_used({}, stay_on_one_processor) == 1);
  CHECK(threads_used({"--threads", "2"}, stay_on_one_processor) == 2);
}

}  // namespace heightlight
