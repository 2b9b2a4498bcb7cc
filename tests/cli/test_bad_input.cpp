#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <string>

#include "command.h"
#include "files/image_file.h"
#include "heightlight/image.h"

// Whatever is wrong with the input, the user gets one line that names it, an exit code, and no file.

namespace heightlight {
namespace {

std::set<std::string> entries(const ScratchFolder& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

/// The inputs that the cases below refer to.
void write_inputs(const ScratchFolder& folder) {
  Image<std::uint16_t> levels(16, 16);
  for (std::size_t i = 0; i < levels.size(); ++i) levels.values[i] = static_cast<std::uint16_t>(i * 200);
  write_png16(folder / "map.png", levels);
  const std::string png = read_text(folder / "map.png");
  write_text(folder / "truncated.png", png.substr(0, png.size() / 2));
  write_text(folder / "empty.png", "");
  write_text(folder / "text.png", "these are not the pixels you are looking for");
  write_text(folder / "zero.asc", "ncols 0\nnrows 0\nxllcorner 0\nyllcorner 0\ncellsize 10\n");
  write_text(folder / "holes.asc",
             "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9\n-9 -9\n-9 -9\n");
  write_png16(folder / "small.png", Image<std::uint16_t>(8, 8));
  const Map bright(16, 16, 1.5F);
  write_float_image(folder / "bright.exr", {{"Y", &bright}});
  std::filesystem::copy_file(folder / "map.png", folder / "height.png");
  std::filesystem::create_directory(folder / "folder.png");
  write_text(folder / "file", "a file where a folder should be");
}

struct Case {
  const char* arguments;
  int exit_code;
  const char* names;  // what the line must name
  const char* fault;  // and say of it
};

TEST_CASE("bad input gets one line that names it, and leaves no file behind", "[cli]") {
  const Case which = GENERATE(
      Case{"simulate missing.png -o out", 1, "missing.png", "no such file"},
      Case{"simulate folder.png -o out", 1, "folder.png", "directory"},
      Case{"simulate empty.png -o out", 1, "empty.png", "empty"},
      Case{"simulate truncated.png -o out", 1, "truncated.png", "truncated"},
      Case{"simulate text.png -o out", 1, "text.png", "not"},
      Case{"simulate zero.asc -o out", 1, "zero.asc", "0"},
      Case{"simulate map.png -o out --memory 20k", 1, "map.png", "--memory"},
      Case{"simulate map.png -o out --memory 100k --rays 65536", 1, "map.png", "--memory"},
      Case{"simulate holes.asc -o out", 1, "holes.asc", "missing"},
      Case{"simulate height.png -o .", 2, "height.png", "replace"},
      Case{"simulate map.png -o file/out", 1, "file", ""}, Case{"simulate map.png -o file", 1, "file", ""},
      Case{"simulate map.png -o out --albedo 1.5", 2, "--albedo 1.5", "[0, 1]"},
      Case{"simulate map.png -o out --albedo 0.1,0.2", 2, "--albedo 0.1,0.2", "three"},
      Case{"simulate map.png -o out --albedo=-0.5", 2, "--albedo", "[0, 1]"},
      Case{"simulate map.png -o out --albedo small.png", 1, "small.png", "8 × 8"},
      Case{"simulate map.png -o out --albedo bright.exr", 1, "bright.exr", "[0, 1]"},
      Case{"simulate map.png -o out --albedo nothing.png", 1, "nothing.png", "no such file"},
      Case{"simulate map.png -o out --relief -1", 2, "--relief", "positive"},
      Case{"simulate map.png -o out --relief nan", 2, "--relief", "positive"},
      Case{"simulate map.png -o out --rays 0", 2, "--rays 0", "65536"},
      Case{"simulate map.png -o out --rays 65537", 2, "--rays 65537", "65536"},
      Case{"simulate map.png -o out --visibility foo", 2, "--visibility", "foo"},
      Case{"simulate map.png -o out --visibility horizon --rays 5", 2, "--rays", "--visibility rays"},
      Case{"simulate map.png -o out --error -1", 2, "--error -1", "from 0 to 1"},
      Case{"simulate map.png -o out --error nan", 2, "--error nan", "from 0 to 1"},
      Case{"simulate map.png -o out --error 1.5", 2, "--error 1.5", "from 0 to 1"},
      Case{"simulate map.png -o out --error none", 2, "--error", "none"},
      Case{"simulate map.png -o out --rays 64 --error 0.01", 2, "--error", "--rays"},
      Case{"simulate map.png -o out --azimuths 0", 2, "--azimuths 0", "even"},
      Case{"simulate map.png -o out --azimuths 7", 2, "--azimuths 7", "even"},
      Case{"simulate map.png -o out --azimuths=-2", 2, "--azimuths -2", "even"},
      Case{"simulate map.png -o out --azimuths 65538", 2, "--azimuths 65538", "65536"},
      Case{"simulate map.png -o out --error 0 --azimuths 7", 2, "--azimuths 7", "even"},
      Case{"simulate map.png -o out --rays 64 --azimuths 32", 2, "--azimuths", "--rays"},
      Case{"simulate map.png -o out --error 0 --memory 100k", 1, "map.png", "--memory"},
      Case{"simulate map.png -o out --bins 0", 2, "--bins 0", "from 1"},
      Case{"simulate map.png -o out --bounces 0", 2, "--bounces 0", "from 1"},
      Case{"simulate map.png -o out --boundary round", 2, "--boundary", "round"},
      Case{"simulate map.png -o out --texel 1y2", 2, "--texel", "1y2"},
      Case{"simulate map.png -o out --memory plenty", 2, "plenty", "memory"},
      Case{"simulate map.png -o out --threads=-1", 2, "--threads", ""},
      Case{"simulate map.png", 2, "--output", "required"},
      Case{"simulate map.png -o out --unheard-of", 2, "--unheard-of", ""},
      Case{"simulate map.png -o out --seed -1", 2, "--seed", "whole number"},
      Case{"simulate map.png -o out --seed 18446744073709551616", 2, "--seed", "whole number"},
      Case{"synth brick -o s.png --seed -1", 2, "--seed", "whole number"},
      Case{"synth brick -o s.png --seed 1e3", 2, "--seed", "whole number"},
      Case{"bake map.png -o out --seed -1", 2, "--seed", "whole number"},
      Case{"compare map.png -o out --seed -1", 2, "--seed", "whole number"},
      Case{"fit map.png -o out --seed -1", 2, "--seed", "whole number"},
      Case{"simulate map.png -o out --relief ''", 2, "--relief", "empty"},
      Case{"simulate map.png -o ''", 2, "-o", "empty"}, Case{"--versio", 2, "--versio", "before a command"},
      Case{"bake map.png -o out --maps=", 2, "--maps", "empty"},
      Case{"simulate '' -o out", 2, "argument", "empty"}, Case{"info ''", 2, "argument", "empty"},
      Case{"dataset '' -o out", 2, "argument", "empty"}, Case{"fit '' -o out", 2, "argument", "empty"},
      Case{"simulate map.png -o out --width 1e-40", 2, "--width", "1e-12"},
      Case{"simulate map.png -o out --width 3e39", 2, "--width", "1e12"},
      Case{"simulate map.png -o out --texel 1e-45", 2, "--texel", "1e-12"},
      Case{"compare map.png -o out --relief 1e40", 2, "--relief", "1e12"},
      Case{"simulate map.png -o out --no-data inf", 2, "--no-data", "missing anyway"},
      Case{"simulat map.png -o out", 2, "simulat", "the commands are simulate"},
      Case{"bake map.png -o out --format gif", 2, "--format", "gif"},
      Case{"info missing.png", 1, "missing.png", "no such file"},
      Case{"synth dodecahedron -o d.png", 2, "dodecahedron", "brick"},
      Case{"synth brick -o d.txt", 2, "d.txt", ".exr"}, Case{"synth brick -o d.png --size 0", 2, "size", "0"},
      Case{"synth brick -o file/d.png", 1, "file", ""}, Case{"", 2, "subcommand", ""});
  const ScratchFolder folder;
  write_inputs(folder);
  const std::set<std::string> before = entries(folder);
  const CommandResult result = run_command(which.arguments, folder);
  INFO(which.arguments << "\n" << result.error);
  CHECK(result.exit_code == which.exit_code);
  CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
  CHECK_THAT(result.error, Catch::StartsWith("heightlight: "));
  CHECK_THAT(result.error, Catch::Contains(which.names, Catch::CaseSensitive::No));
  CHECK_THAT(result.error, Catch::Contains(which.fault, Catch::CaseSensitive::No));
  CHECK_THAT(result.error, !Catch::Contains("->"));  // how the parser keeps values is nobody's to see
  CHECK(result.out.empty());
  CHECK(entries(folder) == before);
}

TEST_CASE("a full disk is reported, and nothing half-written stays", "[cli]") {
  const ScratchFolder folder;
  write_inputs(folder);
  const std::set<std::string> before = entries(folder);
  // A limit on the size of files stands for the full disk: writing past it fails in the same place. (2 KiB:
  // LLVM's OpenMP runtime wants one for itself, in memory.)
  const ScratchFolder streams;
  const std::string line = "cd '" + folder.path().string() +
                           "' && (trap '' XFSZ; ulimit -f 4; '" HEIGHTLIGHT_COMMAND
                           "' simulate map.png -o out --rays 16 2> '" +
                           (streams / "error").string() + "' > /dev/null)";
  const int status = std::system(line.c_str());
  const std::string error = read_text(streams / "error");
  INFO(error);
  CHECK(WEXITSTATUS(status) == 1);
  CHECK(std::count(error.begin(), error.end(), '\n') == 1);
  CHECK_THAT(error, Catch::Contains("curves.csv") && Catch::Contains("cannot be written"));
  CHECK(entries(folder) == before);
}

}  // namespace
}  // namespace heightlight
