#include <algorithm>
#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/hash.h"
#include "cli/manifest.h"
#include "command.h"
#include "folder_contents.h"
#include "heightlight/error.h"
#include "running_command.h"

// Many runs from one manifest: complete, tidy, resumable.

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

constexpr const char* kSmallManifest = R"({
  "maps": [{"shape": "cobbles", "size": 16, "seed": 2}, {"shape": "steps", "size": 12, "name": "stairs"}],
  "relief_shares": [0.1, 0.5],
  "options": [{"rays": 16, "bounces": 3, "bins": 10}]
})";

std::vector<std::string> lines_of(const fs::path& file) {
  std::vector<std::string> lines;
  std::istringstream text(read_text(file));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

nlohmann::json read_dataset(const ScratchFolder& folder) {
  return nlohmann::json::parse(read_text(folder / "out/dataset.json"));
}

std::set<std::string> run_names(const ScratchFolder& folder) {
  std::set<std::string> names;
  const nlohmann::json dataset = read_dataset(folder);
  for (const auto& run : dataset["runs"]) names.insert(run["run"].get<std::string>());
  return names;
}

void make_dataset(const ScratchFolder& folder, const std::string& manifest) {
  write_text(folder / "study.json", manifest);
  const CommandResult result = run_command("dataset study.json -o out --quiet", folder);
  INFO(result.error);
  REQUIRE(result.exit_code == 0);
  CHECK(has_only_warnings(result.error));
}

TEST_CASE("a dataset holds the curves of every run, each as simulate alone would make it", "[cli][dataset]") {
  const ScratchFolder folder;
  make_dataset(folder, kSmallManifest);
  const std::set<std::string> names = run_names(folder);
  REQUIRE(names.size() == 4);
  std::size_t curve_lines = 0;
  for (const std::string& name : names) {
    CHECK(fs::file_size(folder / "out/runs" / name / "curves.svg") > 0);
    curve_lines += lines_of(folder / "out/runs" / name / "curves.csv").size() - 1;
  }
  const std::vector<std::string> table = lines_of(folder / "out/dataset.csv");
  CHECK(table.size() == curve_lines + 1);
  CHECK_THAT(table[0], Catch::StartsWith("run,map,relief_share,boundary,options,ao_kind,bin,ao_lo,"));
  CHECK(lines_of(folder / "out/costs.csv").size() == 5);

  // Heights of .exr files stay as they are, so that their relief must be given; stairs do not tile.
  REQUIRE(run_command("synth steps -o stairs.exr --size 12", folder).exit_code == 0);
  REQUIRE(
      run_command("simulate stairs.exr -o alone --relief 0.5 --boundary open --rays 16 --bounces 3 --bins 10",
                  folder)
          .exit_code == 0);
  const auto stairs = std::find_if(names.begin(), names.end(), [](const std::string& name) {
    return name.starts_with("stairs_relief0.5-");
  });
  REQUIRE(stairs != names.end());
  CHECK((folder_contents(folder / "alone") == folder_contents(folder / "out/runs" / *stairs)));
  const auto first = std::find_if(table.begin(), table.end(), [&](const std::string& line) {
    return line.starts_with(*stairs + ",stairs,0.5,open,,ambient_occlusion,");
  });
  REQUIRE(first != table.end());
  CHECK(lines_of(folder / "alone/curves.csv")[1] == first->substr(first->find("ambient_occlusion")));
}

TEST_CASE("a dataset's provenance names version, inputs, options, seeds and errors", "[cli][dataset]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o 'eine Wand.png' --size 20", folder).exit_code == 0);
  make_dataset(folder, R"({"maps": [{"file": "eine Wand.png", "width": 2}],
                           "options": [{"albedo": [0.6, 0.4, 0.2], "seed": 5}]})");
  const nlohmann::json dataset = read_dataset(folder);
  CHECK(dataset["version"].is_string());
  CHECK(dataset["manifest"]["sha256"].get<std::string>().size() == 64);
  const nlohmann::json& run = dataset["runs"][0];
  CHECK(run["source"]["file"] == "eine Wand.png");
  CHECK(run["surface"]["sha256"].get<std::string>().size() == 64);
  CHECK(run["surface"]["relief"].get<double>() == Approx(0.2));  // an image's own: a tenth of the width
  CHECK(run["visibility"]["seed"] == 5);
  CHECK(run["visibility"]["checked"]["total_rmse"].is_number());
  CHECK(run["options"]["albedo"] == "0.6,0.4,0.2");
  CHECK(run["energy"]["sum_max_error"].get<double>() < 1e-5);
  CHECK_THAT(lines_of(folder / "out/dataset.csv")[1], Contains(",eine Wand,0.1,tile,,"));
}

TEST_CASE("made once more, a dataset runs only what is missing, damaged or changed", "[cli][dataset]") {
  const ScratchFolder folder;
  make_dataset(folder, kSmallManifest);
  const auto whole = folder_contents(folder / "out");
  const std::set<std::string> names = run_names(folder);
  const auto summary = [&](const std::string& name) { return folder / "out/runs" / name / "summary.json"; };
  std::map<std::string, std::string> before;
  for (const std::string& name : names) before[name] = read_text(summary(name));

  const std::string missing = *names.begin();
  const std::string damaged = *names.rbegin();
  fs::remove_all(folder / "out/runs" / missing);
  write_text(summary(damaged), "{\"energy\": ");
  make_dataset(folder, kSmallManifest);
  CHECK((folder_contents(folder / "out") == whole));
  for (const std::string& name : names) {
    // The times inside tell whether it was made again.
    if (name != missing && name != damaged) CHECK((read_text(summary(name)) == before[name]));
  }

  std::string changed = kSmallManifest;
  changed.replace(changed.find("0.5"), 3, "0.7");
  make_dataset(folder, changed);
  const std::set<std::string> now = run_names(folder);
  std::vector<std::string> kept;
  std::set_intersection(names.begin(), names.end(), now.begin(), now.end(), std::back_inserter(kept));
  CHECK(now.size() == 4);
  CHECK(kept.size() == 2);
  CHECK(std::distance(fs::directory_iterator(folder / "out/runs"), fs::directory_iterator()) == 6);

  make_dataset(folder, kSmallManifest);  // what left the tables has stayed, and counts again
  CHECK(run_names(folder) == names);
}

TEST_CASE("a changed input is simulated again, an option without effect is not", "[cli][dataset]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.png --size 12 --seed 1", folder).exit_code == 0);
  make_dataset(folder, R"({"maps": [{"file": "map.png"}], "options": [{"rays": 300}]})");
  const std::set<std::string> first = run_names(folder);
  make_dataset(folder,
               R"({"maps": [{"file": "map.png"}], "options": [{"visibility": "rays", "bounces": 20}]})");
  CHECK(run_names(folder) == first);
  REQUIRE(run_command("synth fbm -o map.png --size 12 --seed 2", folder).exit_code == 0);
  make_dataset(folder, R"({"maps": [{"file": "map.png"}], "options": [{"rays": 300}]})");
  CHECK(run_names(folder) != first);
}

TEST_CASE("a map that fails does not stop the others, and is told at the end", "[cli][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "broken.png", "no picture");
  write_text(folder / "study.json", R"({"maps": [{"file": "absent.png"}, {"file": "broken.png"},
                                                  {"shape": "fbm", "size": 8}], "options": [{"rays": 4}]})");
  const CommandResult result = run_command("dataset study.json -o out --quiet", folder);
  CHECK(result.exit_code == 1);
  INFO(result.error);
  CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 3);
  CHECK_THAT(result.error, Contains("absent.png: no such file") && Contains("broken.png: holds text") &&
                               Contains("study.json: 2 of 3 runs could not be done"));
  CHECK(run_names(folder).size() == 1);
  const nlohmann::json failed = read_dataset(folder)["failed"];
  REQUIRE(failed.size() == 2);
  CHECK_THAT(failed[1]["fault"].get<std::string>(), Contains("broken.png"));
}

TEST_CASE("a wrong manifest is refused with file and place", "[cli][dataset]") {
  const auto [manifest, place] = GENERATE(
      std::pair{"", "study.json: is empty"}, std::pair{"{", "study.json: parse error at line 1, column 2"},
      std::pair{"\xff\xfe", "study.json: is text in UTF-16"},
      std::pair{"[]", "study.json: /: must be an object"}, std::pair{"{}", "study.json: /: needs \"maps\""},
      std::pair{R"({"maps": []})", "study.json: /maps: must be a list that is not empty"},
      std::pair{R"({"maps": [{"shape": "brick"}], "maps": [{"shape": "brick"}]})", "\"maps\" stands twice"},
      std::pair{R"({"maps": [{"shape": "brick"}], "relief": [1]})", "/: there is no key \"relief\" here"},
      std::pair{R"({"maps": [{"shape": "brick"}, {"shape": "igloo"}]})", "/maps/1/shape: there is no shape"},
      std::pair{R"({"maps": [{"shape": "brick", "file": "a.png"}]})", "/maps/0: must have either"},
      std::pair{R"({"maps": [{"shape": "brick", "texel": 1}]})", "/maps/0: there is no key \"texel\" here"},
      std::pair{R"({"maps": [{"shape": "brick", "size": 0}]})", "/maps/0/size: must be an integer from 1"},
      std::pair{R"({"maps": [{"shape": "brick", "size": 1.5}]})", "/maps/0/size: must be an integer"},
      std::pair{R"({"maps": [{"shape": "brick", "seed": 18446744073709551615}]})", "/maps/0/seed: must be"},
      std::pair{R"({"maps": [{"shape": "brick"}, {"shape": "brick"}]})", "/maps/1: the name \"brick_512_1\""},
      std::pair{R"({"maps": [{"shape": "brick", "name": "../x"}]})",
                "/maps/0: \"../x\" cannot name a folder"},
      std::pair{R"({"maps": [{"file": "a.png", "width": -1}]})", "/maps/0/width: must be a positive number"},
      std::pair{R"({"maps": [{"file": "a.png", "texel": [1, 2, 3]}]})", "/maps/0/texel: must be one spacing"},
      std::pair{R"({"maps": [{"file": "a.png", "texel": 1, "width": 1}]})",
                "/maps/0: \"width\" and \"texel\""},
      std::pair{R"({"maps": [{"file": "a.png", "boundary": "round"}]})", "/maps/0/boundary: \"round\""},
      std::pair{R"({"maps": [{"file": 7}]})", "/maps/0/file: must be a text"},
      std::pair{R"({"maps": [{"shape": "brick"}], "relief_shares": [0.1, 0]})", "/relief_shares/1: must be"},
      std::pair{R"({"maps": [{"shape": "brick"}], "relief_shares": [0.1, 0.1]})",
                "/relief_shares/1: 0.1 is given"},
      std::pair{R"({"maps": [{"shape": "brick"}], "boundaries": ["tile", "tile"]})",
                "/boundaries/1: \"tile\""},
      std::pair{R"({"maps": [{"shape": "brick"}], "options": [{}, {}]})", "/options/0: needs a \"name\""},
      std::pair{R"({"maps": [{"shape": "brick"}], "options": [{"rays": 70000}]})", "/options/0: rays 70000"},
      std::pair{R"({"maps": [{"shape": "brick"}], "options": [{"azimuths": 7}]})", "/options/0: azimuths 7"},
      std::pair{R"({"maps": [{"shape": "brick"}], "options": [{"albedo": 2}]})",
                "/options/0/albedo: must be"},
      std::pair{R"({"maps": [{"shape": "brick"}], "options": [{"albedo": [1, 1]}]})", "/options/0/albedo"});
  const ScratchFolder folder;
  const fs::path path = write_text(folder / "study.json", manifest);
  std::string fault;
  try {
    read_manifest(path);
  } catch (const Error& error) {
    fault = error.what();
  }
  INFO(manifest);
  CHECK_THAT(fault, Catch::StartsWith(path.string() + ": ") && Contains(place));
  CHECK(fault.find('\n') == std::string::npos);
}

TEST_CASE("a wrong manifest makes nothing", "[cli][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "study.json", R"({"maps": [{"shape": "igloo"}]})");
  const CommandResult result = run_command("dataset study.json -o out", folder);
  CHECK(result.exit_code == 1);
  CHECK(result.error == "heightlight: study.json: /maps/0/shape: there is no shape \"igloo\"\n");
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("a manifest that the results would replace is refused", "[cli][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "dataset.json", R"({"maps": [{"shape": "flat", "size": 4}]})");
  const CommandResult result = run_command("dataset dataset.json -o .", folder);
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.error, Contains("dataset.json: the results would replace it"));
  CHECK(folder.entry_count() == 1);
}

TEST_CASE("killed at random moments and started again, a dataset is the same to the last byte",
          "[cli][dataset][slow]") {
  const ScratchFolder folder;
  write_text(folder / "study.json", kSmallManifest);
  const std::vector<std::string> undisturbed{"dataset", "study.json", "-o", "whole", "--quiet"};
  const std::vector<std::string> disturbed{"dataset", "study.json", "-o", "killed", "--quiet"};
  const auto start = std::chrono::steady_clock::now();
  REQUIRE(RunningCommand(undisturbed, folder.path()).wait().exit_code == 0);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const auto expected = folder_contents(folder / "whole");

  constexpr int kKills = 16;
  std::uint64_t random = 1;
  for (int kills = 0; kills < kKills;) {
    random = scramble(random);
    RunningCommand command(disturbed, folder.path());
    const ProcessEnd end = command.interrupt_after(unit_real(random) * seconds.count(), SIGKILL);
    INFO(command.error_output());
    REQUIRE((end.signal == SIGKILL || end.exit_code == 0));
    if (end.signal == SIGKILL) {
      ++kills;
      continue;
    }
    CHECK((folder_contents(folder / "killed") == expected));
    fs::remove_all(folder / "killed");
  }
  REQUIRE(RunningCommand(disturbed, folder.path()).wait().exit_code == 0);
  CHECK((folder_contents(folder / "killed") == expected));
}

TEST_CASE("an interrupted dataset stops with the signal's exit code and goes on afterwards",
          "[cli][dataset]") {
  const int signal = GENERATE(SIGINT, SIGTERM);
  const ScratchFolder folder;
  write_text(folder / "study.json",
             R"({"maps": [{"shape": "fbm", "size": 8}, {"shape": "brick", "size": 128}],
                                        "options": [{"rays": 20000, "bounces": 2}]})");
  RunningCommand command({"dataset", "study.json", "-o", "out", "--quiet"}, folder.path());
  while (!fs::exists(folder / "out/maps/brick_128_1.exr"))
    std::this_thread::yield();  // the first run is done
  const ProcessEnd end = command.interrupt_after(0.2, signal);
  CHECK(end.exit_code == 128 + signal);
  CHECK(command.error_output() == "heightlight: interrupted\n");
  CHECK_FALSE(fs::exists(folder / "out/dataset.csv"));
  CHECK(std::distance(fs::directory_iterator(folder / "out/runs"), fs::directory_iterator()) == 1);
}

}  // namespace
}  // namespace heightlight
