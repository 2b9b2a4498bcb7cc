#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "results.h"

namespace heightlight {
namespace {

TEST_CASE("a bake is made anew where what lies below the horizontal, azimuths or curvature change",
          "[cli][bake][terrain]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o hill.exr --size 24", folder).exit_code == 0);
  const std::string bake =
      "bake hill.exr -o out --maps ao,horizon --boundary open --texel 100 --azimuths 8 --depth float "
      "--format exr --skip-existing ";
  REQUIRE(run_command(bake, folder).exit_code == 0);
  for (const char* option : {"--below-horizontal ground", "--azimuth-convention math", "--curvature",
                             "--curvature 0.2", "--curvature=0"}) {
    INFO(option);
    const CommandResult first = run_command(bake + option, folder);
    CHECK(first.error.empty());
    CHECK(first.out.find("1 baked, 0 skipped") != std::string::npos);
    CHECK(run_command(bake + option, folder).out.find("0 baked, 1 skipped") != std::string::npos);
  }
  const nlohmann::json sidecar = nlohmann::json::parse(read_text(folder / "out" / "hill_bake.json"));
  CHECK(sidecar["map"]["lowered_by"]["times_squared_distance"] == Approx(0.5 / 6371008.8).epsilon(1e-12));
}

TEST_CASE("terrain options that make no sense are refused in a line", "[cli][terrain]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o hill.exr --size 16", folder).exit_code == 0);
  const auto [options, named] = GENERATE(table<std::string, std::string>(
      {{"--curvature 0.13 --boundary tile", "--curvature: "},
       {"--curvature 1 --boundary open", "--curvature 1: "},
       {"--curvature=-0.1 --boundary open", "--curvature -0.1: "},
       {"--maps ao-n --below-horizontal ground", "--below-horizontal ground: "},
       {"--horizon-azimuths 361", "--horizon-azimuths 361: "},
       {"--below-horizontal lava", "--below-horizontal: "},
       {"--azimuth-convention south", "--azimuth-convention: "}}));
  const CommandResult run = run_command("bake hill.exr -o out " + options, folder);
  INFO(options << ": " << run.error);
  CHECK(run.exit_code == 2);
  CHECK(run.error.find(named) != std::string::npos);
}

TEST_CASE("simulate takes curvature, too", "[cli][terrain]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o hill.exr --size 16", folder).exit_code == 0);
  const std::string simulate =
      "simulate hill.exr -o s --boundary open --texel 1000 --curvature --bounces 1 --error 0.05";
  CHECK(run_command(simulate, folder).exit_code == 0);
  const nlohmann::json summary = nlohmann::json::parse(read_text(folder / "s" / "summary.json"));
  CHECK(summary["map"].contains("lowered_by"));
}

}  // namespace
}  // namespace heightlight
