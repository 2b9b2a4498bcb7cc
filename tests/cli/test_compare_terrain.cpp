#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"

namespace heightlight {
namespace {

using Catch::Contains;

TEST_CASE("compare --terrain writes its tables, report, plots and evidence",
          "[cli][compare][terrain][slow]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.png --size 24", folder).exit_code == 0);
  const CommandResult run = run_command(
      "compare map.png -o out --boundary open --relief 0.3 --terrain --sun 90,25.5 --albedo 0.4", folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK_THAT(run.out, Contains("lines in out"));
  for (const char* name : {"terrain_forms.csv", "terrain_methods.csv", "terrain.md", "terrain_methods.svg",
                           "terrain_methods.png", "terrain.json"})
    CHECK(std::filesystem::file_size(folder / (std::string("out/") + name)) > 500);
  CHECK(std::distance(std::filesystem::directory_iterator(folder / "out"), {}) == 6);
  const nlohmann::json json = nlohmann::json::parse(read_text(folder / "out/terrain.json"));
  CHECK(json["sun"]["azimuth_degrees_from_north"].get<double>() == Approx(90).margin(1e-9));
  CHECK(json["sun"]["elevation_degrees"].get<double>() == Approx(25.5));
  CHECK(json["albedos"] == std::vector<double>{0.4});
  CHECK(json["truth"].size() == 2);
  CHECK(json["truth"][1]["visibility"]["checked"]["receivers"].get<int>() > 0);
  CHECK(json["files"].size() == 5);
  const std::string report = read_text(folder / "out/terrain.md");
  CHECK_THAT(report, Contains("90° from north and 25.5° high"));
  CHECK_THAT(report, Contains("albedo 0.4"));
}

TEST_CASE("compare --terrain says how much memory it needs", "[cli][compare][terrain]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.png --size 64", folder).exit_code == 0);
  const CommandResult run =
      run_command("compare map.png -o out --boundary open --terrain --memory 1M", folder);
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.error,
             Contains("map.png: reading ") && Contains("that the program itself takes (--memory "));
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

TEST_CASE("compare --terrain refuses what it cannot try", "[cli][compare][terrain]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.png --size 16", folder).exit_code == 0);
  const auto refused = [&](const std::string& options) {
    const CommandResult run = run_command("compare map.png -o out " + options, folder);
    INFO(options << ": " << run.error);
    CHECK(run.exit_code == 2);
    CHECK(std::count(run.error.begin(), run.error.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
    return run.error;
  };
  CHECK_THAT(refused("--terrain"), Contains("--boundary tile"));
  CHECK_THAT(refused("--terrain --boundary open --sun 135,-5"), Contains("--sun"));
  CHECK_THAT(refused("--terrain --boundary open --sun 135,95"), Contains("--sun"));
  CHECK_THAT(refused("--terrain --boundary open --sun 135"), Contains("--sun 135"));
  CHECK_THAT(refused("--terrain --boundary open --sun south,30"), Contains("--sun south,30"));
  CHECK_THAT(refused("--terrain --boundary open --albedo map.png"), Contains("--albedo map.png"));
  CHECK_THAT(refused("--terrain --boundary open --albedo 2"), Contains("--albedo"));
  refused("--sun 135,30");
  refused("--terrain --boundary open --sky map.exr");
  refused("--terrain --boundary open --form 'mine = A'");
}

}  // namespace
}  // namespace heightlight
