// Every command with every kind of input, called what it may be called, being what it may be.

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "command.h"
#include "running_command.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

enum class Kind { map, folder, sky, curves, manifest };

/// A command that reads an input: its arguments, IN and OUT among them, and a file that it writes into OUT.
struct Use {
  const char* name;
  Kind kind;
  std::vector<std::string> arguments;
  std::string result;  ///< empty where it writes none
};

const std::vector<Use>& uses() {
  static const std::vector<std::string> kQuick{"--threads", "1", "--quiet"};
  static const std::vector<Use> all = [] {
    std::vector<Use> made{
        {"info's map", Kind::map, {"info", "IN"}, ""},
        {"simulate's map", Kind::map, {"simulate", "IN", "-o", "OUT", "--rays", "4"}, "height.png"},
        {"simulate's albedo",
         Kind::map,
         {"simulate", "good.png", "-o", "OUT", "--rays", "4", "--albedo", "IN"},
         "curves.png"},
        {"bake's map",
         Kind::map,
         {"bake", "IN", "-o", "OUT", "--maps", "ao", "--azimuths", "4"},
         "in_ao.png"},
        {"bake's folder",
         Kind::folder,
         {"bake", "IN", "-o", "OUT", "--maps", "ao", "--azimuths", "4"},
         "rock_ao.png"},
        {"bake's albedo",
         Kind::map,
         {"bake", "good.png", "-o", "OUT", "--maps", "multibounce", "--azimuths", "4", "--albedo", "IN"},
         "good_multibounce.png"},
        {"compare's map", Kind::map, {"compare", "IN", "-o", "OUT", "--azimuths", "4"}, "errors.png"},
        {"compare's albedo",
         Kind::map,
         {"compare", "good.png", "-o", "OUT", "--azimuths", "4", "--albedo", "IN"},
         "pareto.svg"},
        {"compare's sky",
         Kind::sky,
         {"compare", "good.png", "-o", "OUT", "--azimuths", "4", "--sky", "IN"},
         "sky_light.png"},
        {"fit's curves", Kind::curves, {"fit", "IN", "-o", "OUT", "--bootstrap", "20"}, "models.csv"},
        {"dataset's manifest", Kind::manifest, {"dataset", "IN", "-o", "OUT"}, "dataset.json"}};
    for (Use& use : made) {
      for (const std::string& word : kQuick) {
        use.arguments.push_back(word);
      }
    }
    return made;
  }();
  return all;
}

/// Good inputs of each kind, in a folder that every user may write into.
class Inputs {
 public:
  Inputs() {
    fs::permissions(folder.path(), fs::perms::all);
    REQUIRE(run_command("synth brick -o good.png --size 16", folder).exit_code == 0);
    REQUIRE(run_command("simulate good.png -o run --rays 16 --bins 20 --quiet", folder).exit_code == 0);
    write_text(folder / "manifest.json",
               R"({"maps": [{"shape": "fbm", "size": 8}], "options": [{"rays": 4}]})");
    const std::string texels("\x80\x80\x80\x81\x80\x80\x80\x81", 8);  // (1, 1, 1), twice
    write_text(folder / "sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + texels);
    fs::create_directory(folder / "rocks");
    fs::copy_file(folder / "good.png", folder / "rocks/rock.png");
  }

  fs::path good(Kind kind) const {
    switch (kind) {
      case Kind::map:
        return folder / "good.png";
      case Kind::folder:
        return folder / "rocks";
      case Kind::sky:
        return folder / "sky.hdr";
      case Kind::curves:
        return folder / "run/curves.csv";
      case Kind::manifest:
        break;
    }
    return folder / "manifest.json";
  }

  ProcessEnd run(const Use& use, const std::string& input, std::string& error, bool as_nobody = false) const {
    std::vector<std::string> words = use.arguments;
    for (std::string& word : words) {
      if (word == "IN") word = input;
      if (word == "OUT") word = "out";
    }
    RunningCommand command(words, folder.path(), [&] {
      if (as_nobody && (setgid(65534) != 0 || setuid(65534) != 0)) _exit(126);
    });
    const ProcessEnd end = command.wait();
    error = command.error_output();
    return end;
  }

  ScratchFolder folder;
};

bool is_one_line(const std::string& error) {
  return error.starts_with("heightlight: ") && std::count(error.begin(), error.end(), '\n') == 1;
}

}  // namespace

TEST_CASE("every command reads every kind of input by a name that is no UTF-8, and through a link",
          "[cli][deep]") {
  const Inputs inputs;
  const std::string name = GENERATE("in\xff\xfe", "link to");
  for (const Use& use : uses()) {
    const fs::path good = inputs.good(use.kind);
    const std::string input = name + good.extension().string();
    if (name == "link to") {
      fs::create_symlink(good, inputs.folder / input);
    } else {
      fs::copy(good, inputs.folder / input, fs::copy_options::recursive);
    }
    std::string error;
    const ProcessEnd end = inputs.run(use, input, error);
    INFO(use.name << "\n" << error);
    CHECK(end.exit_code == 0);
    CHECK(has_only_warnings(error));
    if (!use.result.empty() && use.name != std::string("bake's map"))  // whose results have its name
      CHECK(fs::exists(inputs.folder / "out" / use.result));
    fs::remove_all(inputs.folder / "out");
    fs::remove_all(inputs.folder / input);
  }
}

TEST_CASE("no command replaces any kind of input, by whatever name the results would find it", "[cli]") {
  const Inputs inputs;
  for (const Use& use : uses()) {
    if (use.result.empty()) continue;
    const fs::path good = inputs.good(use.kind);
    const std::string input = "in" + good.extension().string();
    fs::copy(good, inputs.folder / input, fs::copy_options::recursive);
    const fs::path file =
        use.kind == Kind::folder ? inputs.folder / input / "rock.png" : inputs.folder / input;
    fs::create_directory(inputs.folder / "out");
    fs::create_hard_link(file, inputs.folder / "out" / use.result);
    const std::string before = read_text(file);
    std::string error;
    const ProcessEnd end = inputs.run(use, input, error);
    INFO(use.name << "\n" << error);
    CHECK(end.exit_code == 2);
    CHECK(is_one_line(error));
    CHECK_THAT(error, Catch::Contains("would replace it") && Catch::Contains("--output"));
    CHECK(read_text(file) == before);
    CHECK(std::distance(fs::directory_iterator(inputs.folder / "out"), fs::directory_iterator()) == 1);
    fs::remove_all(inputs.folder / "out");
    fs::remove_all(inputs.folder / input);
  }
}

TEST_CASE("every command names an input that is not there, or leads in a circle", "[cli]") {
  const Inputs inputs;
  fs::create_symlink("circle", inputs.folder / "circle");
  const auto [input, fault] =
      GENERATE(std::pair{"absent", "no such file"}, std::pair{"circle", "symbolic links"});
  for (const Use& use : uses()) {
    std::string error;
    const ProcessEnd end = inputs.run(use, input, error);
    INFO(use.name << "\n" << error);
    CHECK(end.exit_code == 1);
    CHECK(is_one_line(error));
    CHECK_THAT(error, Catch::Contains(input) && Catch::Contains(fault));
    CHECK_FALSE(fs::exists(inputs.folder / "out"));
  }
}

TEST_CASE("every command names an input that may not be read", "[cli]") {
  const Inputs inputs;
  const bool as_root = getuid() == 0;  // who may read everything
  const Use version{"", Kind::map, {"--version"}, ""};
  std::string error;
  if (as_root && inputs.run(version, "", error, true).exit_code != 0) {
    WARN("SKIPPED: other users cannot run the command here");
    return;
  }
  for (const Use& use : uses()) {
    const fs::path good = inputs.good(use.kind);
    const std::string input = "locked" + good.extension().string();
    fs::copy(good, inputs.folder / input, fs::copy_options::recursive);
    fs::permissions(inputs.folder / input, fs::perms::none);
    const ProcessEnd end = inputs.run(use, input, error, as_root);
    INFO(use.name << "\n" << error);
    CHECK(end.exit_code == 1);
    CHECK(is_one_line(error));
    CHECK_THAT(error, Catch::Contains(input) && Catch::Contains("ermission denied"));
    CHECK_FALSE(fs::exists(inputs.folder / "out"));
    fs::permissions(inputs.folder / input, fs::perms::all);
    fs::remove_all(inputs.folder / input);
  }
}

}  // namespace heightlight
