// Heightmaps as people have them, through every command: ../shared/cases writes them and says what is right.

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "command.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "results.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

/// Where the cases are; empty where they cannot be made here.
fs::path make_cases(const ScratchFolder& folder) {
  const fs::path program = fs::path(HEIGHTLIGHT_SHARED_DIR) / "cases/make_cases.py";
  const std::string line =
      "/usr/bin/python3 '" + program.string() + "' '" + (folder / "cases").string() + "' > /dev/null 2>&1";
  if (fs::exists(program) && std::system(line.c_str()) == 0) return folder / "cases";
  WARN("SKIPPED: " << program.string() << " is absent, or python3-pil");
  return {};
}

/// What is to be known of a map, as info, and everybody else, tells it.
struct Right {
  const char* file;
  std::size_t missing;
  double lowest;
  double highest;
  const char* warned;   ///< of what; empty: of nothing to do with the samples
  const char* advised;  ///< an option with its value
};

const Right kRight[] = {
    {"no_data_beyond_float.tif", 100, 500, 800, "", ""},
    {"no_data_seventeen_digits.tif", 100, 500, 800, "", ""},
    {"no_data_broken_text.tif", 0, -9999, 800, "-1.#IND", "--no-data -9999"},
    {"no_data_fraction.asc", 100, 500, 800, "", ""},
    {"no_data_undeclared.asc", 100, 500, 800, "-9999", ""},
    {"void_int16.tif", 0, -32768, 800, "far below", "--no-data -32768"},
    {"pixel_size.tif", 0, 500, 800, "", ""},
    {"alpha_void.png", 100, 50, 200, "100 of its samples are transparent", ""},
    {"grey_trns.png", 100, 50, 200, "100 of its samples are transparent", ""},
    {"bad_ancillary_sum.png", 0, 0, 65535, "tEXt", ""},
    {"depth_background.tif", 0, 5, 1e10, "far above", "--no-data 1e+10"},
    {"one_wild_sample.tif", 0, 500, 32767, "one sample, in row", "--no-data 32767"},
    {"white_is_zero_8.tif", 0, 0, 252, "", ""},
    {"white_is_zero_16.tif", 0, 0, 252, "", ""},
    {"byte_order_mark.asc", 0, 500, 800, "", ""},
    {"unit_floats.tif", 0, 0, 1, "relief is 1 of the width", "--relief 0.1"},
    {"gaps_in_levels.png", 0, 0, 200, "terraces 0.0025 high", ""},
};

std::string option_of(const std::string& remedy) {
  std::string option = "--" + remedy;
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

}  // namespace

TEST_CASE("files as people have them are read as they are meant, or warned of", "[cli][cases]") {
  const ScratchFolder folder;
  const fs::path cases = make_cases(folder);
  if (cases.empty()) return;
  for (const Right& right : kRight) {
    INFO(right.file);
    const LoadedHeightmap loaded = load_heightmap(cases / right.file, {}, 1 << 24);
    CHECK(count_missing(loaded.map) == right.missing);
    CHECK(loaded.facts.lowest == right.lowest);
    CHECK(loaded.facts.highest == right.highest);
    std::string warnings;
    for (const Warning& warning : loaded.warnings)
      warnings += warning.message + " (" + option_of(warning.remedy) + ")\n";
    CHECK_THAT(warnings, Contains(right.warned) && Contains(right.advised));
    if (*right.warned == '\0') CHECK_THAT(warnings, !Contains("samples are -") && !Contains("far "));
  }
  const LoadedHeightmap grey = load_heightmap(cases / "white_is_zero_8.tif", {}, 1 << 24);
  CHECK(grey.map.height == load_heightmap(cases / "white_is_zero_16.tif", {}, 1 << 24).map.height);
  CHECK(grey.facts.white_is_zero);
  const Heightmap placed = load_heightmap(cases / "pixel_size.tif", {}, 1 << 24).map;
  CHECK(placed.spacing.x == 30);
  CHECK(placed.boundary == Boundary::open);
  const LoadOptions metres{.texel = Spacing{30, 30}, .no_data = -32768};
  CHECK(relief(load_heightmap(cases / "void_int16.tif", metres, 1 << 24).map) == 300);
  for (const Warning& warning : load_heightmap(cases / "tiles_well.png", {}, 1 << 24).warnings)
    CHECK_THAT(warning.message, !Contains("edges"));
}

TEST_CASE("what info knows of a map, every command tells", "[cli][cases][slow]") {
  const ScratchFolder folder;
  const fs::path cases = make_cases(folder);
  if (cases.empty()) return;
  const auto [file, advice] =
      GENERATE(table<std::string, std::string>({{"void_int16.tif", "--no-data -32768"},
                                                {"void_high.tif", "--no-data 1e+20"},
                                                {"depth_background.tif", "--no-data 1e+10"},
                                                {"one_wild_sample.tif", "--no-data 32767"},
                                                {"unit_floats.tif", "--relief 0.1"}}));
  write_text(folder / "study.json",
             "{\"maps\": [{\"file\": \"cases/" + file + "\"}], \"options\": [{\"rays\": 4}]}");
  std::vector<std::string> commands{"info cases/" + file, "simulate cases/" + file + " -o s --rays 4 --quiet",
                                    "bake cases/" + file + " -o b --maps ao --azimuths 4 --quiet",
                                    "dataset study.json -o d --quiet"};
  // It takes a minute, and reads as the others do.
  if (file == "void_int16.tif") commands.push_back("compare cases/" + file + " -o c --azimuths 4 --quiet");
  for (const std::string& arguments : commands) {
    const CommandResult run = run_command(arguments, folder);
    INFO(arguments << "\n" << run.error);
    CHECK_THAT(run.out + run.error, Contains(advice));
    if (file != "void_high.tif") CHECK(run.exit_code == 0);
  }
  if (file != "void_int16.tif") return;
  const std::string told = "far below all others";
  CHECK_THAT(read_text(folder / "s/summary.json"), Contains(told));
  CHECK_THAT(read_text(folder / "b/void_int16_bake.json"), Contains(told));
  CHECK_THAT(read_text(folder / "c/compare.json"), Contains(told));
  CHECK_THAT(read_text(folder / "c/report.md"), Contains("Warning: 100 samples are"));
}

TEST_CASE("a file that kills a library is refused, and its folder worked through", "[cli][cases]") {
  const ScratchFolder folder;
  const fs::path cases = make_cases(folder);
  if (cases.empty()) return;
  for (const std::string& command :
       std::vector<std::string>{"info", "simulate -o o --rays 4", "compare -o o", "bake -o o"}) {
    const CommandResult run = run_command(command + " cases/tiled_cmyk.tif", folder);
    CHECK(run.exit_code == 1);
    CHECK_THAT(run.error, Contains("tiled_cmyk.tif: a CMYK image in tiles is not supported"));
  }
  const CommandResult batch = run_command("bake cases -o out --maps ao --azimuths 4 --quiet", folder);
  INFO(batch.error);
  CHECK(batch.exit_code == 1);
  CHECK_THAT(batch.error, Contains("tiled_cmyk.tif: ") && Contains("maps could not be baked"));
  CHECK(fs::exists(folder / "out/white_is_zero_8_ao.png"));
}

}  // namespace heightlight
