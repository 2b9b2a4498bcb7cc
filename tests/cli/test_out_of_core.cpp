#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "base/hash.h"
#include "cli/command.h"
#include "cli/folder_contents.h"
#include "cli/results.h"
#include "cli/running_command.h"

using namespace heightlight;
namespace fs = std::filesystem;

namespace {

/// Everything that a bake wrote but its sidecar, which tells how long it took.
std::map<std::string, std::string> textures_in(const fs::path& folder) {
  std::map<std::string, std::string> contents = folder_contents(folder);
  std::erase_if(contents, [](const auto& entry) { return entry.first.ends_with(".json"); });
  return contents;
}

nlohmann::json read_sidecar(const fs::path& folder) {
  return nlohmann::json::parse(read_text(folder / "map_bake.json"));
}

double rms_difference(const Picture& a, const Picture& b, int row, int column) {
  double squares = 0;
  for (int i = 0; i < b.height; ++i) {
    for (int j = 0; j < b.width; ++j) {
      const auto at = static_cast<std::size_t>((row + i) * a.width + column + j);
      const double difference =
          double{a.values[at]} - double{b.values[static_cast<std::size_t>(i * b.width + j)]};
      squares += difference * difference;
    }
  }
  return std::sqrt(squares / static_cast<double>(b.values.size()));
}

}  // namespace

TEST_CASE("out of core, a bake has the bytes of one in memory", "[out-of-core]") {
  const ScratchFolder folder;
  const std::string maps =
      " --maps ao,multibounce,bent-normal,sh,normal,height,horizon --albedo 0.7,0.5,0.2 --format tif "
      "--depth float --quiet --relief 0.1 ";
  REQUIRE(run_command("synth fbm -o map.tif --size 320", folder).exit_code == 0);
  SECTION("of a map that tiles") {
    REQUIRE(run_command("bake map.tif -o whole --boundary tile" + maps, folder).exit_code == 0);
    REQUIRE(run_command("bake map.tif -o parts --boundary tile --out-of-core 128" + maps, folder).exit_code ==
            0);
  }
  SECTION("of an open one, on one thread, reached as far as a twentieth") {
    const std::string reached =
        " --boundary open --maps ao,bent-normal --max-distance 5% --falloff linear --format tif --quiet ";
    REQUIRE(run_command("bake map.tif -o whole" + reached, folder).exit_code == 0);
    REQUIRE(run_command("bake map.tif -o parts --out-of-core 192 --threads 1" + reached, folder).exit_code ==
            0);
  }
  const auto whole = textures_in(folder / "whole");
  const auto parts = textures_in(folder / "parts");
  CHECK(whole.size() >= 2);
  CHECK((whole == parts));
  const nlohmann::json told = read_sidecar(folder / "parts");
  CHECK(told["map"] == read_sidecar(folder / "whole")["map"]);
  CHECK(told["errors"]["ao_rmse"].get<double>() > 0);
  CHECK(told["errors"]["ao_rmse"].get<double>() < 0.003);
}

TEST_CASE("killed again and again, a bake out of core goes on, to the same bytes", "[out-of-core][slow]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 256", folder).exit_code == 0);
  const std::vector<std::string> bake{"bake",           "map.png",  "-o",  "parts",         "--maps",
                                      "ao,multibounce", "--format", "tif", "--out-of-core", "64",
                                      "--quiet"};
  REQUIRE(run_command("bake map.png -o whole --maps ao,multibounce --format tif --quiet", folder).exit_code ==
          0);
  std::uint64_t random = 5;
  int kills = 0;
  bool ended = false;
  for (int i = 0; i < 60 && !ended; ++i) {
    random = scramble(random);
    RunningCommand command(bake, folder.path());
    const ProcessEnd end = command.interrupt_after(0.3 + 1.2 * unit_real(random), SIGKILL);
    ended = end.exit_code == 0;
    kills += end.signal == SIGKILL ? 1 : 0;
    if (!ended) CHECK_FALSE(fs::exists(folder / "parts/map_bake.json"));
  }
  if (!ended) {
    RunningCommand last(bake, folder.path());
    REQUIRE(last.wait().exit_code == 0);
  }
  CHECK(kills > 0);
  CHECK((textures_in(folder / "whole") == textures_in(folder / "parts")));
  CHECK_FALSE(fs::exists(folder / "parts/.map.windows"));
}

TEST_CASE("a window has the whole map's sky, and its light within the error", "[out-of-core]") {
  const ScratchFolder folder;
  const std::string maps =
      " --maps ao,multibounce --albedo 0.8 --format tif --depth float --quiet --relief 0.1 ";
  REQUIRE(run_command("synth fbm -o map.tif --size 1024", folder).exit_code == 0);
  REQUIRE(run_command("bake map.tif -o whole --boundary open" + maps, folder).exit_code == 0);
  REQUIRE(
      run_command("bake map.tif -o part --boundary open --window 500,300,100,70" + maps, folder).exit_code ==
      0);
  const Picture sky = read_picture(folder / "part/map_ao.tif");
  CHECK(sky.width == 100);
  CHECK(sky.height == 70);
  CHECK(rms_difference(read_picture(folder / "whole/map_ao.tif"), sky, 300, 500) == 0);
  const Picture total = read_picture(folder / "part/map_multibounce.tif");
  CHECK(rms_difference(read_picture(folder / "whole/map_multibounce.tif"), total, 300, 500) < 0.0002);
  CHECK_FALSE(fs::exists(folder / "part/.map.windows"));
}

TEST_CASE("a window tells how many of its own samples are missing", "[out-of-core]") {
  const ScratchFolder folder;
  std::ofstream grid(folder / "map.asc");
  grid << "ncols 192\nnrows 192\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n";
  for (int row = 0; row < 192; ++row) {
    for (int column = 0; column < 192; ++column) grid << (row < 70 ? -9999 : (row * column) % 7) << ' ';
    grid << '\n';
  }
  grid.close();
  const auto missing = [&](const std::string& window) {
    REQUIRE(run_command("bake map.asc -o part --maps ao --quiet --window " + window, folder).exit_code == 0);
    return read_sidecar(folder / "part")["map"]["missing"].get<int>();
  };
  CHECK(missing("0,64,128,128") == 6 * 128);
  CHECK(missing("64,128,64,64") == 0);
}

TEST_CASE("what windows cannot do is said in one line, and nothing is written", "[out-of-core]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.tif --size 128", folder).exit_code == 0);
  REQUIRE(run_command("synth fbm -o odd.tif --size 100", folder).exit_code == 0);
  const auto refused = [&](const std::string& arguments, const std::string& why, int code) {
    const CommandResult result = run_command("bake " + arguments + " -o out", folder);
    INFO(arguments << ": " << result.error);
    CHECK(result.exit_code == code);
    CHECK(result.error.find(why) != std::string::npos);
    CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  refused("map.tif --out-of-core 100", "--out-of-core 100: must be a multiple of 64", 2);
  refused("map.tif --out-of-core 64 --maps ao-n", "ao-n", 2);
  refused("map.tif --out-of-core 64 --maps openness-negative", "openness-negative", 2);
  refused("map.tif --out-of-core 64 --maps multibounce --albedo map.tif", "albedo", 2);
  refused("map.tif --out-of-core 64 --maps ao,multibounce --max-distance 5%", "max-distance", 2);
  refused("map.tif --window 1,2,3", "COLUMN,ROW,WIDTH,HEIGHT", 2);
  refused("map.tif --window 100,0,64,64", "inside the map", 2);
  refused("map.tif --window 0,0,0,64", "inside the map", 2);
  refused("odd.tif --out-of-core 64 --boundary tile", "sides that 8 divides", 1);
  refused("missing.tif --out-of-core 64", "missing.tif", 1);
}
