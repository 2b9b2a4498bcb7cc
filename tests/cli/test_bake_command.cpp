#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "results.h"

namespace heightlight {
namespace {

bool has_lines(const std::string& text, std::ptrdiff_t count) {
  return std::count(text.begin(), text.end(), '\n') == count;
}

TEST_CASE("bake works through files and folders, goes on after a bad one, and skips what is there",
          "[cli][bake]") {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "heights");
  REQUIRE(run_command("synth brick -o heights/brick.png --size 40", folder).exit_code == 0);
  REQUIRE(run_command("synth fbm -o 'heights/f b m.exr' --size 33", folder).exit_code == 0);
  write_text(folder / "heights" / "broken.png", "no picture");
  write_text(folder / "heights" / "notes.txt", "not looked at");
  REQUIRE(run_command("synth sines -o sines.png --size 24", folder).exit_code == 0);
  const std::string bake = "bake heights sines.png -o out --maps ao,normal --azimuths 8";
  const CommandResult first = run_command(bake, folder);
  INFO(first.error);
  CHECK(first.exit_code == 1);
  CHECK(first.error.find("heights/broken.png: ") != std::string::npos);
  CHECK(first.error.find("1 of 4 maps could not be baked") != std::string::npos);
  CHECK(first.out.find("3 baked, 0 skipped, 1 failed") != std::string::npos);
  for (const char* name : {"brick_ao.png", "f b m_ao.png", "f b m_normal.png", "sines_bake.json"}) {
    CHECK(std::filesystem::file_size(folder / "out" / name) > 0);
  }
  CHECK_FALSE(std::filesystem::exists(folder / "out" / "broken_ao.png"));
  const CommandResult second = run_command(bake + " --skip-existing", folder);
  CHECK(second.exit_code == 1);
  CHECK(second.out.find("0 baked, 3 skipped, 1 failed") != std::string::npos);
  std::filesystem::remove(folder / "heights" / "broken.png");
  CHECK(run_command(bake + " --skip-existing", folder).exit_code == 0);
}

TEST_CASE("a folder baked into itself is not baked from its results", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 16", folder).exit_code == 0);
  REQUIRE(run_command("bake . -o . --maps ao --azimuths 8", folder).exit_code == 0);
  const CommandResult again = run_command("bake . -o . --maps ao --azimuths 8", folder);
  CHECK(again.out.find("1 baked") != std::string::npos);
  CHECK_FALSE(std::filesystem::exists(folder / "brick_ao_ao.png"));
}

TEST_CASE("the sidecar says what was asked for and what came of it", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 64", folder).exit_code == 0);
  const CommandResult run = run_command(
      "bake brick.png -o out --maps ao,multibounce --albedo '#b5533c' --max-distance 10% --falloff sqrt "
      "--depth 8 "
      "--dither --normal-y directx --pack R=ao,G=height,A=multibounce.r",
      folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json sidecar = nlohmann::json::parse(read_text(folder / "out" / "brick_bake.json"));
  CHECK(sidecar["map"]["width"] == 64);
  CHECK(sidecar["reach"]["max_distance"].get<double>() == Approx(0.1));
  CHECK(sidecar["reach"]["falloff"] == "sqrt");
  CHECK(sidecar["albedo"][0].get<double>() == Approx(0.462).margin(0.001));  // sRGB 0xb5
  CHECK(sidecar["files"].size() == 3);
  CHECK(sidecar["files"][2]["file"] == "brick_packed.png");
  CHECK(sidecar["files"][2]["channels"].size() == 4);
  CHECK(sidecar["errors"]["ao_rmse"].get<double>() < 0.004);
  CHECK(sidecar["errors"]["multibounce_rmse"].get<double>() < 0.004);
  CHECK(sidecar["visibility"]["checked_sky"]["receivers"] == 256);
  CHECK(sidecar["visibility"]["checked"]["receivers"].get<int>() >= 256);
  CHECK(sidecar["visibility"]["expected_rmse"]["total_from_gathers"].get<double>() > 0);
  CHECK(sidecar["links"]["count"] == 0);
  CHECK(sidecar["links"]["bytes"] == 0);
  CHECK(sidecar["memory"]["estimated_bytes"].get<std::uint64_t>() > 0);
  const Picture total = read_picture(folder / "out" / "brick_multibounce.png");
  CHECK(total.channels == std::vector<std::string>{"R", "G", "B"});
}

struct Fault {
  const char* arguments;
  int exit_code;
  const char* names;
};

TEST_CASE("bake refuses what makes no sense in one line, and leaves nothing behind", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 16", folder).exit_code == 0);
  REQUIRE(run_command("synth brick -o brick.exr --size 16", folder).exit_code == 0);
  std::filesystem::create_directory(folder / "empty");
  const Fault fault =
      GENERATE(Fault{"bake brick.png -o out --maps ao,shiny", 2, "'shiny'"},
               Fault{"bake brick.png -o out --maps ao,ao", 2, "twice"},
               Fault{"bake brick.png -o out --depth half", 2, "--depth"},
               Fault{"bake brick.png -o out --format exr --depth 8", 2, "--depth"},
               Fault{"bake brick.png -o out --dither", 2, "--dither"},
               Fault{"bake brick.png -o out --falloff linear", 2, "--falloff"},
               Fault{"bake brick.png -o out --max-distance far", 2, "--max-distance"},
               Fault{"bake brick.png -o out --max-distance -1", 2, "--max-distance"},
               Fault{"bake brick.png -o out --pack R=ao,R=height", 2, "--pack"},
               Fault{"bake brick.png -o out --pack R=ao.z", 2, "component 2"},
               Fault{"bake brick.png -o out --pack R=multibounce.g", 2, "component 1"},
               Fault{"bake brick.png -o out --maps multibounce --albedo 2", 2, "--albedo"},
               Fault{"bake brick.png -o out --error 0", 2, "--error"},
               Fault{"bake brick.png brick.exr -o out", 2, "different folders"},
               Fault{"bake missing.png -o out", 1, "missing.png"}, Fault{"bake empty -o out", 1, "empty"},
               Fault{"bake brick.png -o brick.png", 1, "brick.png"});
  INFO(fault.arguments);
  const CommandResult run = run_command(fault.arguments, folder);
  INFO(run.error);
  CHECK(run.exit_code == fault.exit_code);
  CHECK(has_lines(run.error, 1));
  CHECK(run.error.find(fault.names) != std::string::npos);
  CHECK(folder.entry_count() == 3);
}

}  // namespace
}  // namespace heightlight
