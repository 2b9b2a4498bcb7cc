// Random tiny maps through every solver; what must agree is compared (solver_checks.h). Exit code 1 where
// something does not, with the command that shows it again.
//     heightlight_differential [--maps N] [--seed S] [--seconds T]

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>

#include "base/hash.h"
#include "random_map.h"
#include "solver_checks.h"

int main(int argument_count, char** arguments) {
  using namespace heightlight;
  std::uint64_t maps = 1000;
  std::uint64_t seed = 1;
  double seconds = 1e9;
  CLI::App app{"Compares all solvers on random tiny maps"};
  app.add_option("--maps", maps, "maps to try (1000)");
  app.add_option("--seed", seed, "of the first map; the next has the next (1)");
  app.add_option("--seconds", seconds, "stop after so long");
  CLI11_PARSE(app, argument_count, arguments);

  constexpr int kMostTold = 20;
  const auto start = std::chrono::steady_clock::now();
  LargestDifferences largest;
  std::uint64_t tried = 0;
  int faulty = 0;
  for (; tried < maps; ++tried) {
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > seconds) break;
    const RandomMap random = make_random_map(seed + tried);
    const Surface surface = build_surface(random.map);
    const std::vector<std::string> faults = compare_solvers(surface, seed + tried, largest);
    if (faults.empty()) continue;
    if (++faulty > kMostTold) continue;
    std::printf("--maps 1 --seed %llu: %s\n", static_cast<unsigned long long>(seed + tried),
                random.description.c_str());
    for (const std::string& fault : faults) std::printf("  %s\n", fault.c_str());
  }
  std::printf(
      "%llu maps, %d with a mismatch; largest differences: slices and rays %.2g (where screening asked), "
      "lanes and twin %.2g, the gather's lanes %.2g, sky + sum F from 1 %.2g\n",
      static_cast<unsigned long long>(tried), faulty, largest.slices_and_rays, largest.lanes_and_twin,
      largest.gather_lanes, largest.row_sum);
  return faulty == 0 ? 0 : 1;
}
