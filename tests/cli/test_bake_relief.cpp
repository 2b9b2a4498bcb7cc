#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "command.h"
#include "results.h"
#include "shared_data.h"

namespace heightlight {
namespace {

nlohmann::json sidecar_of(const ScratchFolder& folder, const std::string& name) {
  return nlohmann::json::parse(read_text(folder / "out" / (name + "_bake.json")));
}

double relief_of(const ScratchFolder& folder, const std::string& name) {
  return sidecar_of(folder, name)["map"]["relief"].get<double>();
}

TEST_CASE("heights and extents may have units, and reliefs the maps' names", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 32", folder).exit_code == 0);
  REQUIRE(run_command("synth fbm -o fbm.png --size 32", folder).exit_code == 0);
  REQUIRE(run_command("bake brick.png -o out --maps height --height 5cm --size 2m", folder).exit_code == 0);
  CHECK(relief_of(folder, "brick") == Approx(0.05).epsilon(1e-6));
  CHECK(sidecar_of(folder, "brick")["map"]["texel"][0].get<double>() == Approx(2.0 / 32));
  write_text(folder / "reliefs.csv",
             "name,relief,width\n# of the library\nbrick,2cm,50cm\nfbm.png,0.3\nnobody,1\n");
  const CommandResult table =
      run_command("bake brick.png fbm.png -o out --maps height --reliefs reliefs.csv --quiet", folder);
  CHECK(table.exit_code == 0);
  CHECK(table.error.find("no map here is called nobody") != std::string::npos);
  CHECK(relief_of(folder, "brick") == Approx(0.02).epsilon(1e-6));
  CHECK(sidecar_of(folder, "brick")["map"]["texel"][0].get<double>() == Approx(0.5 / 32));
  CHECK(relief_of(folder, "fbm") == Approx(0.3).epsilon(1e-6));
  REQUIRE(run_command("bake brick.png fbm.png -o out --maps height --relief 0.2 --reliefs fbm=1cm", folder)
              .exit_code == 0);
  CHECK(relief_of(folder, "brick") == Approx(0.2).epsilon(1e-6));
  CHECK(relief_of(folder, "fbm") == Approx(0.01).epsilon(1e-6));
}

TEST_CASE("reliefs that make no sense are told with their place", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o fbm.png --size 16", folder).exit_code == 0);
  write_text(folder / "bad.txt", "fbm 0.1\nbrick tall\n");
  write_text(folder / "twice.txt", "fbm 0.1\n\nfbm 0.2\n");
  write_text(folder / "minus.csv", "fbm,-1cm\n");
  write_text(folder / "empty.txt", "# nothing\n");
  const auto refused = [&](const std::string& arguments, const std::string& why, int code) {
    const CommandResult result = run_command("bake fbm.png -o out " + arguments, folder);
    INFO(arguments << ": " << result.error);
    CHECK(result.exit_code == code);
    CHECK(result.error.find(why) != std::string::npos);
    CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  };
  refused("--reliefs bad.txt", "bad.txt: line 2: 'tall'", 1);
  refused("--reliefs twice.txt", "twice.txt: line 3: 'fbm' is given twice", 1);
  refused("--reliefs minus.csv", "minus.csv: line 1: '-1cm' must be positive", 1);
  refused("--reliefs empty.txt", "empty.txt: contains no reliefs", 1);
  refused("--reliefs nofile", "nofile", 1);
  refused("--reliefs fbm=x", "--reliefs: 'x'", 2);
  refused("--height 5cn", "--height 5cn", 2);
  refused("--height 5cm --relief 1", "excludes", 2);
  refused("--size 1m --width 2", "--size 1m", 2);
  refused("--size 1", "1024x512", 2);
  refused("--match nofile", "nofile: no such file", 1);
  refused("--match fbm.png --relief 1", "excludes", 2);
  refused("--sheet --window 0,0,8,8", "sheet", 2);
  refused("--maps curvature --window 0,0,8,8", "curvature", 2);
}

TEST_CASE("a relief that was guessed and is absurd is told with one that is not", "[cli][bake]") {
  const auto leather = find_shared_data("material/Leather031_height16.png");
  if (!leather) return;
  const ScratchFolder folder;
  const CommandResult guessed =
      run_command("bake '" + leather->string() + "' -o out --maps height --shrink 2", folder);
  CHECK(guessed.error.find("since nothing tells its relief") != std::string::npos);
  CHECK(guessed.error.find("(--relief 0.0") != std::string::npos);
  const CommandResult given = run_command(
      "bake '" + leather->string() + "' -o out --maps height --shrink 2 --height 1mm --size 30cm", folder);
  CHECK(given.error.empty());
}

TEST_CASE("the maps that were baked give back the relief that they were baked at", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth cobbles -o map.png --size 64", folder).exit_code == 0);
  REQUIRE(run_command("bake map.png -o maps --maps ao,normal --relief 0.05 --normal-y directx", folder)
              .exit_code == 0);
  for (const char* shipped : {"maps/map_ao.png", "maps/map_normal.png"}) {
    INFO(shipped);
    const CommandResult match =
        run_command("bake map.png -o out --maps height --match " + std::string(shipped), folder);
    CHECK(match.exit_code == 0);
    CHECK(relief_of(folder, "map") == Approx(0.05).epsilon(0.03));
    CHECK(match.out.find("correlation 1.00") != std::string::npos);
    CHECK(sidecar_of(folder, "map")["map"]["relief_from"].get<std::string>().starts_with("matched to map_"));
    const CommandResult again = run_command(
        "bake map.png -o out --maps height --skip-existing --match " + std::string(shipped), folder);
    CHECK(again.out.find("1 skipped") != std::string::npos);
  }
  REQUIRE(run_command("synth fbm -o other.png --size 64", folder).exit_code == 0);
  const CommandResult doubtful =
      run_command("bake other.png -o out --maps height --quiet --match maps/map_ao.png", folder);
  CHECK(doubtful.error.find("--match is doubtful") != std::string::npos);
  CHECK(run_command("bake map.png other.png -o out2 --match maps/map_ao.png", folder).exit_code == 2);
}

TEST_CASE("materials that ship their occlusion are matched to sensible reliefs", "[cli][bake][slow]") {
  for (const auto& [heights, occlusion, low, high] :
       {std::tuple{"DiamondPlate008C_height16.png", "DiamondPlate008C_ao.png", 0.01, 0.025},
        {"Ground054_height16.png", "Ground054_ao.png", 0.02, 0.05},
        {"Bricks102_height.jpg", "Bricks102_ao.jpg", 0.008, 0.025}}) {
    const auto map = find_shared_data(std::string("material/") + heights);
    const auto shipped = find_shared_data(std::string("material/") + occlusion);
    if (!map || !shipped) return;
    const ScratchFolder folder;
    const CommandResult run = run_command(
        "bake '" + map->string() + "' -o out --maps height --match '" + shipped->string() + "'", folder);
    INFO(run.out << run.error);
    CHECK(run.exit_code == 0);
    CHECK(run.error.find("doubtful") == std::string::npos);
    const double relief = relief_of(folder, map->stem().string());
    CHECK(relief > low);
    CHECK(relief < high);
  }
}

TEST_CASE("a sheet stands beside the maps", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 32", folder).exit_code == 0);
  REQUIRE(run_command("bake brick.png -o out --maps height --sheet --albedo 0.6,0.3,0.2", folder).exit_code ==
          0);
  const Picture sheet = read_picture(folder / "out" / "brick_sheet.png");
  CHECK(sheet.channels.size() == 3);
  CHECK(sheet.width > sheet.height);
  REQUIRE(run_command("bake brick.png -o out --maps height --relief 0.2", folder).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "out" / "brick_sheet.png"));  // of other heights
}

TEST_CASE("a window's displacement is the whole map's", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.tif --size 128", folder).exit_code == 0);
  const std::string maps = " --maps displacement,normal --normal-strength 2 --format exr ";
  REQUIRE(run_command("bake map.tif -o whole" + maps, folder).exit_code == 0);
  REQUIRE(run_command("bake map.tif -o part --out-of-core 64" + maps, folder).exit_code == 0);
  for (const char* file : {"map_displacement.exr", "map_normal.exr"})
    CHECK(read_picture(folder / "whole" / file).values == read_picture(folder / "part" / file).values);
}

}  // namespace
}  // namespace heightlight
