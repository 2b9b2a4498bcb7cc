// What was estimated beforehand is what is held: the peak of a large map over that of a tiny one, which
// leaves out what programs hold anyway.

#include <catch2/catch.hpp>
#include <string>

#include "command.h"
#include "results.h"

namespace heightlight {
namespace {

constexpr int kLarge = 1536;

/// The `memory` of a run's sidecar or summary.
struct Memory {
  double peak = 0;
  double estimated = 0;
};

Memory memory_of(const ScratchFolder& folder, const std::string& command, const std::string& file) {
  const CommandResult run = run_command(command + " -o out --error 0.01 --threads 2 --quiet", folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json memory = nlohmann::json::parse(read_text(folder / "out" / file))["memory"];
  return {memory["peak_bytes"].get<double>(), memory["estimated_bytes"].get<double>()};
}

void check_estimate(const ScratchFolder& folder, const std::string& before, const std::string& options,
                    const std::string& suffix) {
  const auto file = [&](const std::string& map) { return suffix.empty() ? "summary.json" : map + suffix; };
  const Memory small = memory_of(folder, before + " small.png " + options, file("small"));
  const Memory large = memory_of(folder, before + " large.png " + options, file("large"));
  const double held = large.peak - small.peak;
  const double estimated = large.estimated - small.estimated;
  INFO(before << ' ' << options << ": " << held / 1e6 << " MB held, " << estimated / 1e6 << " estimated");
  CHECK(held < 1.25 * estimated);  // ao alone: what reading and compressing leave behind
  CHECK(held > 0.7 * estimated);
}

}  // namespace

TEST_CASE("memory is what it was estimated to be", "[cli][slow]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o small.png --size 32", folder).exit_code == 0);
  REQUIRE(run_command("synth fbm -o large.png --size " + std::to_string(kLarge), folder).exit_code == 0);
  for (const char* maps :
       {"ao", "ao,bent-normal,sh", "multibounce", "ao,ao-n,multibounce --albedo 0.9,0.5,0.2"}) {
    check_estimate(folder, "bake", std::string("--maps ") + maps, "_bake.json");
  }
  check_estimate(folder, "bake", "--pack R=ao,G={stem}.png,B={stem}.png:srgb,A=1-{stem}.png", "_bake.json");
  check_estimate(folder, "simulate", "--bounces 3", "");
}

}  // namespace heightlight
