// What an earlier run left in a folder does not mix with what a later one writes there.

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "results.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

void simulate_into(const ScratchFolder& folder, const std::string& rest) {
  const CommandResult run = run_command("simulate " + rest + " --rays 16 --bins 20 --quiet", folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
}

}  // namespace

TEST_CASE("files of an earlier simulation that the next does not write go away with it", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o a.png --size 24 --seed 1", folder).exit_code == 0);
  REQUIRE(run_command("synth brick -o b.png --size 24 --seed 2", folder).exit_code == 0);
  simulate_into(folder, "a.png -o o --save-bounces --save-links --bounces 6");
  write_text(folder / "o/notes.txt", "the user's own");
  simulate_into(folder, "b.png -o o --bounces 4");
  CHECK_FALSE(fs::exists(folder / "o/irradiance_00.exr"));
  CHECK_FALSE(fs::exists(folder / "o/irradiance_06.exr"));
  CHECK_FALSE(fs::exists(folder / "o/links.npz"));
  CHECK(fs::exists(folder / "o/notes.txt"));
  // A file under such a name that is another by now is not ours to take away.
  simulate_into(folder, "a.png -o o --save-bounces --bounces 6");
  write_text(folder / "o/irradiance_03.exr", "edited");
  simulate_into(folder, "b.png -o o --save-bounces --bounces 2");
  CHECK(fs::exists(folder / "o/irradiance_02.exr"));
  CHECK_FALSE(fs::exists(folder / "o/irradiance_04.exr"));
  CHECK(read_text(folder / "o/irradiance_03.exr") == "edited");
}

TEST_CASE("the summary records every file beside it", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o a.png --size 24", folder).exit_code == 0);
  simulate_into(folder, "a.png -o o --save-bounces --bounces 2");
  const nlohmann::json files = read_summary(folder / "o")["files"];
  CHECK(static_cast<std::ptrdiff_t>(files.size()) + 1 ==
        std::distance(fs::directory_iterator(folder / "o"), fs::directory_iterator()));
  for (const nlohmann::json& file : files) {
    CHECK(fs::file_size(folder / "o" / file["file"].get<std::string>()) ==
          file["bytes"].get<std::uint64_t>());
    CHECK(file["sha256"].get<std::string>().size() == 64);
  }
}

TEST_CASE("fit refuses curves and bounces of different runs", "[cli][fit][slow]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o a.png --size 32 --seed 1", folder).exit_code == 0);
  REQUIRE(run_command("synth brick -o b.png --size 32 --seed 2", folder).exit_code == 0);
  simulate_into(folder, "a.png -o a --save-bounces");
  simulate_into(folder, "b.png -o b --save-bounces");
  const std::string mixed =
      GENERATE("curves.csv", "irradiance_05.exr", "sky_view_factor.exr", "summary.json");
  CAPTURE(mixed);
  CHECK(run_command("fit a/curves.csv -o good --bootstrap 20 --quiet", folder).exit_code == 0);
  fs::copy_file(folder / "b" / mixed, folder / "a" / mixed, fs::copy_options::overwrite_existing);
  const CommandResult run = run_command("fit a/curves.csv -o out --bootstrap 20", folder);
  CHECK(run.exit_code == 1);
  CHECK_THAT(run.error, Contains("a/") && Contains("mixed") && Contains("summary.json"));
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("maps of an earlier bake stay beside new ones of the same heights, and go away with others",
          "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o a.png --size 24", folder).exit_code == 0);
  const auto bake = [&](const std::string& options) {
    return run_command("bake a.png -o o --azimuths 4 --maps " + options, folder);
  };
  REQUIRE(bake("ao,normal").exit_code == 0);
  write_text(folder / "o/a_height.png", "the user's own");
  REQUIRE(bake("bent-normal").exit_code == 0);
  CHECK(fs::exists(folder / "o/a_ao.png"));
  const auto sidecar = nlohmann::json::parse(read_text(folder / "o/a_bake.json"));
  REQUIRE(sidecar["files"].size() == 3);
  CHECK(sidecar["files"][1]["file"] == "a_ao.png");
  CHECK(sidecar["files"][1]["earlier"] == true);
  const CommandResult other = bake("bent-normal --relief 0.05");
  CHECK_THAT(other.out, Contains("removed") && Contains("a_ao.png, a_normal.png"));
  CHECK_FALSE(fs::exists(folder / "o/a_ao.png"));
  CHECK(fs::exists(folder / "o/a_bent-normal.png"));
  CHECK(fs::exists(folder / "o/a_height.png"));
}

TEST_CASE("what goes away is only what a record of that very result lists, as it was, and nobody's input",
          "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o a.png --size 24", folder).exit_code == 0);
  REQUIRE(run_command("synth fbm -o b.png --size 24", folder).exit_code == 0);
  REQUIRE(run_command("bake a.png -o . --azimuths 4 --maps ao,height", folder).exit_code == 0);
  // Maps made before are inputs of this batch.
  REQUIRE(run_command("bake a.png a_height.png a_ao.png b.png -o . --azimuths 4 --maps normal --relief 0.3",
                      folder)
              .exit_code == 0);
  CHECK(fs::exists(folder / "a_height.png"));
  CHECK(fs::exists(folder / "a_ao.png"));
  // A sidecar that was copied speaks of another map's files.
  REQUIRE(run_command("bake a.png -o o --azimuths 4 --maps ao", folder).exit_code == 0);
  fs::copy_file(folder / "o/a_bake.json", folder / "o/b_bake.json");
  REQUIRE(run_command("bake b.png -o o --azimuths 4 --maps normal", folder).exit_code == 0);
  CHECK(fs::exists(folder / "o/a_ao.png"));
  // An edit of the same size is an edit.
  std::string bytes = read_text(folder / "o/a_ao.png");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  write_text(folder / "o/a_ao.png", bytes);
  REQUIRE(run_command("bake a.png -o o --azimuths 4 --maps normal --relief 0.05", folder).exit_code == 0);
  CHECK(fs::exists(folder / "o/a_ao.png"));
  // Names out of the folder, or that no such result has, are nobody's to remove.
  write_text(folder / "notes.txt", "mine");
  fs::create_directory(folder / "s");
  write_text(folder / "s/summary.json",
             R"({"files": [{"file": "../notes.txt", "bytes": 4}, {"file": "diary.txt", "bytes": 0}]})");
  write_text(folder / "s/diary.txt", "");
  simulate_into(folder, "a.png -o s");
  CHECK(fs::exists(folder / "notes.txt"));
  CHECK(fs::exists(folder / "s/diary.txt"));
}

TEST_CASE("fit takes a dataset's table as it is, with what its runs left", "[cli][fit][dataset]") {
  const ScratchFolder folder;
  write_text(folder / "study.json",
             R"({"maps": [{"shape": "brick", "size": 32}, {"shape": "cobbles", "size": 32}],
                                       "options": [{"rays": 64, "bins": 40, "save_bounces": true}]})");
  REQUIRE(run_command("dataset study.json -o study --quiet", folder).exit_code == 0);
  const CommandResult whole = run_command("fit study/dataset.csv -o whole --bootstrap 20 --quiet", folder);
  INFO(whole.error);
  REQUIRE(whole.exit_code == 0);
  REQUIRE(run_command("fit study/runs/*/curves.csv -o apart --bootstrap 20 --quiet", folder).exit_code == 0);
  CHECK(read_text(folder / "whole/models.csv") == read_text(folder / "apart/models.csv"));
  const auto models = nlohmann::json::parse(read_text(folder / "whole/models.json"));
  CHECK(models["maps"][0]["material"] == "brick");
  CHECK(models["maps"][1]["texels"] == 1024);
  // The table alone has curves, and no texels.
  fs::copy_file(folder / "study/dataset.csv", folder / "alone.csv");
  REQUIRE(run_command("fit alone.csv -o alone --bootstrap 20 --quiet", folder).exit_code == 0);
  CHECK(nlohmann::json::parse(read_text(folder / "alone/models.json"))["maps"][1]["texels"] == 0);
}

TEST_CASE("a run of a dataset counts only as it was written", "[cli][dataset][slow]") {
  const ScratchFolder folder;
  write_text(folder / "study.json",
             R"({"maps": [{"shape": "brick", "size": 16}], "options": [{"rays": 16, "bins": 20}]})");
  const auto make = [&] { return run_command("dataset study.json -o study --quiet", folder); };
  REQUIRE(make().exit_code == 0);
  const std::string table = read_text(folder / "study/dataset.csv");
  const fs::path run = fs::directory_iterator(folder / "study/runs")->path();
  const std::string name = GENERATE("curves.csv", "height.png", "sky_view_factor.exr", "summary.json");
  const std::string damage = GENERATE("empty", "cut", "digit", "gone", "deep", "foreign", "wrong type");
  CAPTURE(name, damage);
  std::string bytes = read_text(run / name);
  const std::string right = bytes;
  if (damage == "digit") bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  if (damage == "cut") bytes.resize(bytes.size() / 2);
  if (damage == "empty") bytes.clear();
  if (damage == "deep") bytes = std::string(300'000, '[');
  if (damage == "wrong type") bytes = R"({"key": 3, "map": 3, "files": []})";
  if (damage == "foreign") {
    REQUIRE(run_command("synth fbm -o f.png --size 16", folder).exit_code == 0);
    simulate_into(folder, "f.png -o foreign");
    for (const auto& entry : fs::directory_iterator(folder / "foreign"))
      fs::copy_file(entry.path(), run / entry.path().filename(), fs::copy_options::overwrite_existing);
    bytes = read_text(run / name);
  }
  write_text(run / name, bytes);
  if (damage == "gone") fs::remove(run / name);
  const CommandResult again = make();
  INFO(again.error);
  REQUIRE(again.exit_code == 0);
  CHECK(read_text(folder / "study/dataset.csv") == table);
  // A digit of a time in the summary is nobody's to check.
  if (name != "summary.json") CHECK(read_text(run / name) == right);
}

}  // namespace heightlight
