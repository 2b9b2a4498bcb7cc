// No command replaces a file that it reads, whatever that is called: it says so before it computes anything.

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "command.h"

namespace heightlight {
namespace {

void refuses(const ScratchFolder& folder, const std::string& command, const std::string& input) {
  const std::string before = read_text(folder / input);
  REQUIRE_FALSE(before.empty());
  const CommandResult run = run_command(command, folder);
  INFO(command << "\n" << run.error);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.error, Catch::Contains("would replace it") && Catch::Contains("--output"));
  CHECK(read_text(folder / input) == before);
}

void copy(const ScratchFolder& folder, const std::string& from, const std::string& to) {
  std::filesystem::create_directories((folder / to).parent_path());
  std::filesystem::copy_file(folder / from, folder / to);
}

}  // namespace

TEST_CASE("heightmaps are not replaced by results", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 16", folder).exit_code == 0);
  for (const char* name :
       {"height.png", "bounces.png", "curves.png", "errors.png", "pareto.png", "error_01_rays.png"}) {
    copy(folder, "map.png", name);
  }
  refuses(folder, "simulate height.png -o .", "height.png");
  refuses(folder, "simulate bounces.png -o ../$(basename $PWD)", "bounces.png");
  refuses(folder, "compare errors.png -o .", "errors.png");
  refuses(folder, "compare pareto.png -o .", "pareto.png");
  refuses(folder, "compare error_01_rays.png -o .", "error_01_rays.png");
  copy(folder, "map.png", "map_ao.png");
  refuses(folder, "bake map.png map_ao.png -o . --maps ao", "map_ao.png");
  copy(folder, "map.png", "in/rock.png");
  copy(folder, "map.png", "in/rock_ao.png");
  refuses(folder, "bake in -o in --maps ao", "in/rock_ao.png");
}

TEST_CASE("links to results are inputs too", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 16", folder).exit_code == 0);
  copy(folder, "map.png", "out/height.png");
  std::filesystem::create_symlink("out/height.png", folder / "in.png");
  refuses(folder, "simulate in.png -o out", "out/height.png");
  std::filesystem::create_hard_link(folder / "map.png", folder / "out/curves.png");
  refuses(folder, "simulate map.png -o out", "map.png");
}

TEST_CASE("albedos, curves and manifests are not replaced by results", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 16", folder).exit_code == 0);
  copy(folder, "map.png", "map_multibounce.png");
  refuses(folder, "bake map.png -o . --maps multibounce --albedo map_multibounce.png", "map_multibounce.png");
  copy(folder, "map.png", "irradiance_total.png");
  refuses(folder, "simulate map.png -o . --albedo irradiance_total.png", "irradiance_total.png");
  copy(folder, "map.png", "errors.png");
  refuses(folder, "compare map.png -o . --albedo errors.png", "errors.png");
  copy(folder, "map.png", "sky_light.png");
  refuses(folder, "compare map.png -o . --sky sky_light.png", "sky_light.png");
  write_text(folder / "models.csv", "not read");
  refuses(folder, "fit models.csv -o .", "models.csv");
  write_text(folder / "dataset.json", "{\"maps\": [{\"file\": \"map.png\"}]}");
  refuses(folder, "dataset dataset.json -o .", "dataset.json");
  copy(folder, "dataset.json", "origin.json");
  refuses(folder, "dataset origin.json -o .", "origin.json");
  write_text(folder / "study.json", "{\"maps\": [{\"file\": \"costs.csv\"}]}");
  write_text(folder / "costs.csv", "a map of that name");
  refuses(folder, "dataset study.json -o .", "costs.csv");
}

}  // namespace heightlight
