// A batch or a dataset goes on past what is wrong with one of its maps.

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "command.h"
#include "huge_map.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

std::ptrdiff_t lines_in(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

}  // namespace

TEST_CASE("names, links and sizes of some maps do not end a batch", "[cli][bake]") {
  const ScratchFolder folder;
  fs::create_directory(folder / "in");
  REQUIRE(run_command("synth brick -o in/a.png --size 16", folder).exit_code == 0);
  write_huge_map(folder / "in/large.png");
  fs::copy_file(folder / "in/a.png", folder / "in/z\xff.png");
  fs::create_symlink("loop.png", folder / "in/loop.png");
  const CommandResult run = run_command("bake in -o out --maps ao --azimuths 4 --memory 4G", folder);
  INFO(run.error);
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.out, Contains("2 baked, 0 skipped, 2 failed"));
  CHECK_THAT(run.error, Contains("in/loop.png: ") && Contains("in/large.png: ") && Contains("2 of 4 maps"));
  CHECK(fs::exists(folder / "out/z\xff_ao.png"));
  CHECK(fs::exists(folder / "out/z\xff_bake.json"));
}

TEST_CASE("what is wrong with the request is told once, before any map", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o a.png --size 16", folder).exit_code == 0);
  fs::copy_file(folder / "a.png", folder / "b.png");
  const std::string wrong =
      GENERATE("--relief -1", "--width 0", "--texel 0x1", "--max-distance x", "--albedo 2",
               "--max-distance 1e40", "--shrink 0", "--albedo '#123'", "--maps ao,", "--width 1e-40",
               "--no-data nan", "--falloff sqrt", "--albedo absent.png");
  const CommandResult run = run_command("bake a.png b.png -o out " + wrong, folder);
  INFO(wrong << "\n" << run.error);
  CHECK(run.exit_code == (wrong == "--albedo absent.png" ? 1 : 2));
  CHECK(lines_in(run.error) == 1);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("skipping asks whether what is there is what is asked for", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o a.png --size 16", folder).exit_code == 0);
  const std::string bake = "bake a.png -o out --maps ao --azimuths 4 --skip-existing ";
  const auto outcome = [&](const std::string& more) { return run_command(bake + more, folder).out; };
  CHECK_THAT(outcome(""), Contains("1 baked"));
  CHECK_THAT(outcome(""), Contains("1 skipped"));
  CHECK_THAT(outcome("--relief 0.05"), Contains("1 baked"));
  CHECK_THAT(outcome("--relief 0.05"), Contains("1 skipped"));
  CHECK_THAT(outcome("--relief 0.05 --ao uniform"), Contains("1 baked"));
  CHECK_THAT(outcome("--relief 0.05 --ao uniform --depth 8"), Contains("1 baked"));
  CHECK_THAT(outcome(""), Contains("1 baked"));
  write_text(folder / "out/a_ao.png", "");
  CHECK_THAT(outcome(""), Contains("1 baked"));
  REQUIRE(run_command("synth brick -o a.png --size 16 --seed 2", folder).exit_code == 0);
  CHECK_THAT(outcome(""), Contains("1 baked"));
}

TEST_CASE("of a material's folder only the heights are baked, unless a pattern says otherwise",
          "[cli][bake]") {
  const ScratchFolder folder;
  fs::create_directory(folder / "m");
  REQUIRE(run_command("synth brick -o m/Rock003_2K_Displacement.png --size 16", folder).exit_code == 0);
  for (const char* name : {"Rock003_2K_Color.png", "Rock003_2K_NormalGL.png", "Rock003_2K_Roughness.png",
                           "Rock003_2K_AmbientOcclusion.png", "plaster.png"}) {
    fs::copy_file(folder / "m/Rock003_2K_Displacement.png", folder / "m" / name);
  }
  const CommandResult run = run_command("bake m -o out --maps normal --quiet", folder);
  INFO(run.error);
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.error, Contains("4 files were left out, since they are named like other kinds of maps") &&
                            Contains("--pattern"));
  CHECK(fs::exists(folder / "out/Rock003_2K_Displacement_normal.png"));
  CHECK(fs::exists(folder / "out/plaster_normal.png"));
  CHECK_FALSE(fs::exists(folder / "out/Rock003_2K_Color_normal.png"));
  REQUIRE(run_command("bake m -o other --maps normal --pattern '*Rough*' --quiet", folder).exit_code == 0);
  CHECK(fs::exists(folder / "other/Rock003_2K_Roughness_normal.png"));
  CHECK_FALSE(fs::exists(folder / "other/plaster_normal.png"));
}

TEST_CASE("a run whose folder cannot be written does not end a dataset", "[cli][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "study.json", R"({"maps": [{"shape": "brick", "size": 8}, {"shape": "fbm", "size": 8}],
                                       "options": [{"rays": 4}]})");
  REQUIRE(run_command("dataset study.json -o study --quiet", folder).exit_code == 0);
  for (const auto& entry : fs::directory_iterator(folder / "study/runs")) {
    if (!entry.path().filename().string().starts_with("brick")) continue;
    const fs::path run = entry.path();
    fs::remove_all(run);
    fs::create_symlink("nowhere", run);
    break;
  }
  const CommandResult again = run_command("dataset study.json -o study --quiet", folder);
  INFO(again.error);
  CHECK(again.exit_code == 1);
  CHECK_THAT(again.error, Contains("link to nothing") && Contains("1 of 2 runs could not be done"));
  CHECK_THAT(read_text(folder / "study/dataset.csv"), Contains("fbm_8_1"));
}

}  // namespace heightlight
