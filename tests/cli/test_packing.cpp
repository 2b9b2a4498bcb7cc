// Packs of baked maps and of files of the user's own: every channel is read back.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "folder_contents.h"
#include "packing_bench.h"
#include "write_samples.h"

namespace heightlight {

namespace fs = std::filesystem;

TEST_CASE("a pack holds files of one's own to the last level, beside baked maps", "[cli][bake][pack]") {
  const PackingBench bench;
  bench.bake(
      "brick_height.png --depth 8 --maps ao --pack R=ao,G=brick_rough.png,B=rgb.png:G,A=1-brick_metal.png");
  CHECK(channels_of(bench.folder / "out/brick_height_packed.png") ==
        std::vector<std::string>{"R", "G", "B", "A"});
  CHECK(bench.levels("brick_height_packed.png", 0) == bench.levels("brick_height_ao.png", 0));
  CHECK(bench.levels("brick_height_packed.png", 1) == as_levels(bench.rough));
  CHECK(bench.levels("brick_height_packed.png", 2) == bench.rgb_channel(1));
  CHECK(bench.levels("brick_height_packed.png", 3) == inverted(as_levels(bench.metal), 255));
}

TEST_CASE("any number of packs have names of their own, and letters that go together", "[cli][bake][pack]") {
  const PackingBench bench;
  bench.bake(
      "brick_height.png --depth 8 --maps normal --pack tint:RGB=rgb.png,A=brick_rough.png --pack "
      "turned:R=normal.x,G=1-normal.y,B=normal.z --pack grey:R=brick_rough.png --name '{material}-{map}'");
  for (std::size_t c = 0; c < 3; ++c) CHECK(bench.levels("brick-tint.png", c) == bench.rgb_channel(c));
  CHECK(bench.levels("brick-tint.png", 3) == as_levels(bench.rough));
  CHECK(channels_of(bench.folder / "out/brick-grey.png") == std::vector<std::string>{"Y"});
  const ChannelLevels up = bench.levels("brick-normal.png", 1);
  bench.bake("brick_height.png --depth 8 --maps normal --normal-y directx");
  CHECK(bench.levels("brick-turned.png", 1) == bench.levels("brick_height_normal.png", 1));
  CHECK(bench.levels("brick-turned.png", 1) != up);
}

TEST_CASE("16-bit files and files of floats stay what they are", "[cli][bake][pack]") {
  const PackingBench bench;
  std::vector<std::uint16_t> fine;
  std::vector<float> shares;
  for (std::size_t i = 0; i < kBenchTexels; ++i) {
    fine.push_back(static_cast<std::uint16_t>(i * 64 + i / 16));
    shares.push_back(static_cast<float>(fine.back()) / 65535.0F);
  }
  write_samples(bench.folder / "fine.png", kBenchSide, kBenchSide, {"Y"}, fine);
  write_samples(bench.folder / "shares.exr", kBenchSide, kBenchSide, {"gloss"}, shares);
  bench.bake("brick_height.png --pack R=fine.png,G=shares.exr:gloss,B=1-fine.png");
  CHECK(bench.levels("brick_height_packed.png", 0) == as_levels(fine));
  CHECK(bench.levels("brick_height_packed.png", 1) == as_levels(fine));
  CHECK(bench.levels("brick_height_packed.png", 2) == inverted(as_levels(fine), 65535));
}

TEST_CASE("what is said to be sRGB is decoded, and a preset can encode it again", "[cli][bake][pack]") {
  const PackingBench bench;
  bench.bake("brick_height.png --depth 8 --pack R=brick_rough.png:srgb,G=brick_rough.png:linear,B=0.5");
  const ChannelLevels decoded = bench.levels("brick_height_packed.png", 0);
  for (std::size_t i = 0; i < 256; ++i) {  // by IEC 61966-2-1
    const double encoded = static_cast<double>(bench.rough[i]) / 255;
    const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    CHECK(std::abs(decoded.values[i] - 255 * linear) < 0.505);  // the nearest level
  }
  CHECK(bench.levels("brick_height_packed.png", 1) == as_levels(bench.rough));
  CHECK(bench.levels("brick_height_packed.png", 2) == ChannelLevels{std::vector<int>(kBenchTexels, 128)});
  write_text(bench.folder / "own.json", R"({"colour": {"depth": "8", "inputs": {"tint": 0.5}, "files": [
      {"map": "tint", "channels": "R=tint,G=tint,B=0,A=tint", "encoding": "srgb"}]}})");
  bench.bake("brick_height.png --preset-file own.json --preset colour --input tint=brick_rough.png:srgb");
  CHECK(bench.levels("brick_height_tint.png", 0) == as_levels(bench.rough));
  CHECK(bench.levels("brick_height_tint.png", 3) == decoded);  // alpha is linear
}

TEST_CASE("each map finds files of its own, in the folder where it is", "[cli][bake][pack]") {
  const PackingBench bench;
  fs::create_directory(bench.folder / "stone");
  for (const char* name : {"brick_height.png", "brick_rough.png"})
    fs::copy_file(bench.folder / name, bench.folder / "stone" / name);
  fs::copy_file(bench.folder / "brick_height.png", bench.folder / "stone/rock.png");
  fs::copy_file(bench.folder / "brick_metal.png", bench.folder / "stone/rock_rough.png");
  bench.bake("stone --depth 8 --pack R={folder}/{material}_rough.png --name '{stem}_{map}'");
  CHECK(bench.levels("brick_height_packed.png", 0) == as_levels(bench.rough));
  CHECK(bench.levels("rock_packed.png", 0) == as_levels(bench.metal));
}

TEST_CASE("what is there is left out unless a file that was packed changed", "[cli][bake][pack]") {
  const PackingBench bench;
  const std::string bake =
      "bake brick_height.png -o out --azimuths 8 --pack R=ao,G=brick_rough.png --skip-existing";
  CHECK_THAT(run_command(bake, bench.folder).out, Catch::Contains("1 baked, 0 skipped"));
  CHECK_THAT(run_command(bake, bench.folder).out, Catch::Contains("0 baked, 1 skipped"));
  CHECK_THAT(run_command(bake + " --name '{map}_{stem}'", bench.folder).out, Catch::Contains("1 baked"));
  CHECK_THAT(run_command(bake, bench.folder).out, Catch::Contains("1 baked"));
  const auto sidecar = nlohmann::json::parse(read_text(bench.folder / "out/brick_height_bake.json"));
  REQUIRE(sidecar["packed_from"].size() == 1);
  CHECK(sidecar["packed_from"][0]["path"] == "brick_rough.png");
  CHECK(sidecar["packed_from"][0]["sha256"].get<std::string>().size() == 64);
  write_grey(bench.folder, "brick_rough.png", bench.metal);
  CHECK_THAT(run_command(bake, bench.folder).out, Catch::Contains("1 baked"));
  ChannelLevels wide = as_levels(bench.metal);
  for (int& level : wide.values) level *= 257;
  CHECK(bench.levels("brick_height_packed.png", 1) == wide);
}

TEST_CASE("no file that is packed is replaced", "[cli][bake][pack]") {
  const PackingBench bench;
  fs::copy_file(bench.folder / "brick_rough.png", bench.folder / "brick_height_packed.png");
  const auto before = folder_contents(bench.folder.path());
  for (const char* pack : {"--pack R=ao,G=brick_height_packed.png", "--pack R=ao,G={stem}_packed.png",
                           "--pack rough:R=ao,G=brick_rough.png --name '{material}_{map}'"}) {
    const CommandResult run = run_command(std::string("bake brick_height.png -o . ") + pack, bench.folder);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.error, Catch::Contains("would replace it"));
  }
  CHECK(folder_contents(bench.folder.path()) == before);
}

TEST_CASE("packs of baked maps go window by window under any name, those of files do not",
          "[cli][bake][pack]") {
  const PackingBench bench;
  const std::string pack = "brick_height.png --pack set:RGB=normal,A=ao --name 'T_{material}_{map}'";
  bench.bake(pack);
  const ChannelLevels whole = bench.levels("T_brick_set.png", 1);
  bench.bake(pack + " --out-of-core 256");
  CHECK(bench.levels("T_brick_set.png", 1) == whole);
  for (const char* part : {"--out-of-core 256", "--window 0,0,8,8"}) {
    const CommandResult run = run_command(
        std::string("bake brick_height.png -o none --pack R=ao,G=brick_rough.png ") + part, bench.folder);
    CHECK(run.exit_code == 2);
    CHECK_THAT(run.error, Catch::Contains("window by window"));
    CHECK_FALSE(fs::exists(bench.folder / "none"));
  }
}

TEST_CASE("packs that make no sense are refused in one line, and nothing is written", "[cli][bake][pack]") {
  const PackingBench bench;
  write_samples(bench.folder / "small.png", 16, kBenchSide, {"Y"},
                std::vector<std::uint8_t>(std::size_t{16} * kBenchSide));
  write_samples(bench.folder / "bright.exr", kBenchSide, kBenchSide, {"Y"},
                std::vector<float>(kBenchTexels, 1.5F));
  const auto before = folder_contents(bench.folder.path());
  struct Fault {
    const char* arguments;
    int exit_code;
    const char* told;
  };
  const Fault fault = GENERATE(
      Fault{"--pack R=ao,G=small.png", 1, "small.png: has 16 × 32 texels, but the heightmap has 32 × 32"},
      Fault{"--pack R=ao,G=none.png", 1, "none.png: no such file"},
      Fault{"--pack R=ao,G=bright.exr", 1, "bright.exr: has samples outside [0, 1]"},
      Fault{"--pack R=ao,G=rgb.png", 1, "rgb.png: its channels R, G, B differ"},
      Fault{"--pack R=ao,G=rgb.png:Z", 2, "rgb.png: has no channel 'Z'"},
      Fault{"--pack R=ao,G=rgb.png:", 2, "no channel after the colon"},
      Fault{"--pack RG=rgb.png:R", 2, "one channel"}, Fault{"--pack R=ao,G=shiny", 2, "'shiny'"},
      Fault{"--pack R=ao,G={name}.png", 2, "no placeholder {name}"},
      Fault{"--pack R=ao,G={stem", 2, "'{stem' is not a map"},
      Fault{"--pack R=ao,G={stem.png", 2, "not closed"}, Fault{"--pack RGB=ao", 2, "no component 1"},
      Fault{"--pack X=ao", 2, "--pack X=ao"}, Fault{"--pack R", 2, "--pack R"},
      Fault{"--pack R=ao,G=1.5", 2, "1.5 is not in [0, 1]"},
      Fault{"--pack a/b:R=ao", 2, "must not be empty nor contain"},
      Fault{"--pack R=ao --pack G=ao", 2, "two files would be called brick_height_packed.png"},
      Fault{"--pack ao:R=ao --maps ao", 2, "two files would be called brick_height_ao.png"},
      Fault{"--maps ao,normal --name {stem}", 2, "two files would be called brick_height.png"},
      Fault{"--maps ao --name {map}_{size}", 2, "no placeholder {size}"},
      Fault{"--maps ao --name {map}/{stem}", 2, "files cannot be called ao/brick_height.png"},
      Fault{"brick_rough.png --maps ao --name {map}", 2,
            "files of brick_height.png and brick_rough.png would both be called ao.png"},
      Fault{"--pack R=ao --input rough=brick_rough.png", 2, "--input rough: is not used by any pack"},
      Fault{"--pack R=ao,G=rough --input rough", 2, "NAME=FILE"});
  INFO(fault.arguments);
  const CommandResult run =
      run_command(std::string("bake brick_height.png -o out ") + fault.arguments, bench.folder);
  INFO(run.error);
  CHECK(run.exit_code == fault.exit_code);
  CHECK(std::count(run.error.begin(), run.error.end(), '\n') == 1);
  CHECK_THAT(run.error, Catch::Contains(fault.told));
  CHECK(folder_contents(bench.folder.path()) == before);
}

}  // namespace heightlight
