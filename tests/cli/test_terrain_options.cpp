#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
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

TEST_CASE("a bake is made anew where the projection beside its grid changes", "[cli][bake][terrain]") {
  const ScratchFolder folder;
  const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
  write("hill.asc", "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2 3\n4 6 5\n");
  const std::string projection = "Projection UTM\nZone 31\nUnits METERS\n";
  for (const char* format : {"tif", "asc"}) {
    std::filesystem::remove(folder / "hill.prj");
    const std::string bake = std::string("bake hill.asc -o out --maps ao --skip-existing --format ") + format;
    REQUIRE(run_command(bake, folder).exit_code == 0);
    write("hill.prj", projection);
    CHECK(run_command(bake, folder).out.find("1 baked, 0 skipped") != std::string::npos);
    CHECK(run_command(bake, folder).out.find("0 baked, 1 skipped") != std::string::npos);
  }
  CHECK(read_text(folder / "out" / "hill_ao.prj") == projection);
}

TEST_CASE("info says what bake takes a map for", "[cli][terrain]") {
  const ScratchFolder folder;
  std::ofstream(folder / "hill.asc")
      << "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2 3\n4 6 5\n";
  REQUIRE(run_command("synth fbm -o hill.exr --size 16", folder).exit_code == 0);
  const auto [map, kind] = GENERATE(
      table<std::string, std::string>({{"hill.asc", "terrain: its file gives"},
                                       {"hill.asc --boundary tile", "material: the map tiles"},
                                       {"hill.exr", "material: its file gives no"},
                                       {"hill.exr --texel 5 --boundary open", "terrain: a distance"}}));
  INFO(map);
  CHECK(run_command("info " + map, folder).out.find("kind       " + kind) != std::string::npos);
  REQUIRE(run_command("bake " + map + " -o out --maps ao", folder).exit_code == 0);
  CHECK(std::filesystem::exists(folder / "out" /
                                (kind.starts_with("terrain") ? "hill_ao.tif" : "hill_ao.png")));
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
