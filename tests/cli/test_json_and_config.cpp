#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "scratch_folder.h"

// What pipelines use: JSON on stdout, files of options, completion in shells.

namespace heightlight {
namespace {

using nlohmann::json;

/// Each line of what was printed; throws where one is no JSON.
std::vector<json> parse_lines(const std::string& text) {
  std::vector<json> parsed;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) parsed.push_back(json::parse(line));
  return parsed;
}

/// Completions of a line whose last word is still being written, one per line.
std::string complete(const std::string& words, const ScratchFolder& folder) {
  write_text(folder / "try.bash", "source ./heightlight.bash\nCOMP_WORDS=(" + words +
                                      ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_heightlight\n"
                                      "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
  const std::string line = "cd '" + folder.path().string() + "' && bash try.bash > completed 2>&1";
  REQUIRE(std::system(line.c_str()) == 0);
  return read_text(folder / "completed");
}

}  // namespace

TEST_CASE("bake --json prints a line per map and nothing else", "[cli][bake]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 32", folder).exit_code == 0);
  write_text(folder / "broken.png", "no picture");
  const std::string bake = "bake brick.png broken.png -o out --maps ao,normal --azimuths 8 --json";
  const CommandResult run = run_command(bake, folder);
  CHECK(run.exit_code == 1);
  const std::vector<json> lines = parse_lines(run.out);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0]["map"] == "brick.png");
  CHECK(lines[0]["status"] == "done");
  CHECK(lines[0]["files"] == json{"out/brick_ao.png", "out/brick_normal.png", "out/brick_bake.json"});
  CHECK(lines[0]["errors"]["ao_rmse"].get<double>() > 0);
  CHECK(lines[0]["seconds"].get<double>() > 0);
  CHECK(lines[1]["status"] == "failed");
  CHECK(lines[1]["error"].get<std::string>().find("broken.png") != std::string::npos);
  CHECK(lines[1]["files"].empty());
  CHECK(run.error.find("broken.png") != std::string::npos);
  const CommandResult again =
      run_command("bake brick.png -o out --maps ao,normal --azimuths 8 --json --skip-existing", folder);
  CHECK(again.exit_code == 0);
  REQUIRE(parse_lines(again.out).size() == 1);
  CHECK(parse_lines(again.out)[0]["status"] == "skipped");
  CHECK(parse_lines(again.out)[0]["errors"] == lines[0]["errors"]);
  // Files of an earlier bake are told in the line, not on a line of their own.
  const CommandResult other =
      run_command("bake brick.png -o out --maps ao --azimuths 8 --relief 0.2 --json", folder);
  REQUIRE(parse_lines(other.out).size() == 1);
  CHECK(parse_lines(other.out)[0]["removed"] == json{"brick_normal.png"});
}

TEST_CASE("simulate --json and info --json print one line", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 24", folder).exit_code == 0);
  const CommandResult run = run_command("simulate brick.png -o out --json", folder);
  CHECK((run.exit_code == 0 || run.exit_code == 3));  // 3: without gnuplot
  REQUIRE(parse_lines(run.out).size() == 1);
  const json line = parse_lines(run.out)[0];
  CHECK(line["status"] == "done");
  CHECK(line["errors"]["sky_view_factor_rmse"].get<double>() >= 0);
  for (const std::string file : line["files"]) CHECK(std::filesystem::is_regular_file(folder / file));
  CHECK(line["files"].back() == "out/summary.json");
  const CommandResult absent = run_command("simulate absent.png -o out --json", folder);
  CHECK(absent.exit_code == 1);
  REQUIRE(parse_lines(absent.out).size() == 1);
  CHECK(parse_lines(absent.out)[0]["status"] == "failed");
  const CommandResult info = run_command("info brick.png --json", folder);
  CHECK(info.exit_code == 0);
  REQUIRE(parse_lines(info.out).size() == 1);
  const json facts = parse_lines(info.out)[0];
  CHECK(facts["map"]["path"] == "brick.png");
  CHECK(facts["map"]["width"] == 24);
  CHECK(facts["kind"] == "material");
  CHECK(facts["edges"]["wrap"] == true);
}

TEST_CASE("a file of options counts as options do", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 32", folder).exit_code == 0);
  write_text(
      folder / "heightlight.toml",
      "# options of this project\n[simulate]\nbins = 7\n\n[bake]\nmaps = \"ao,multibounce\"  # two\n"
      "albedo = '#a0522d'\nrelief = 0.2\nazimuths = 8\nquiet = true\ndither = false\noutput = \"out\"\n");
  const CommandResult run = run_command("bake brick.png --config heightlight.toml", folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.out.empty());
  const json sidecar = json::parse(read_text(folder / "out" / "brick_bake.json"));
  CHECK(sidecar["map"]["relief"].get<double>() == Approx(0.2));
  CHECK(sidecar["albedo"][0].get<double>() == Approx(0.352).margin(0.001));  // sRGB 0xa0
  // The same options, told otherwise, are the same request.
  const CommandResult told = run_command(
      "bake brick.png -o out --maps ao,multibounce --albedo '#a0522d' --relief 0.2 --azimuths 8 "
      "--skip-existing",
      folder);
  CHECK(told.out.find("0 baked, 1 skipped") != std::string::npos);
  // The command line wins, wherever it stands.
  for (const char* order :
       {"--relief 0.1 --config heightlight.toml", "--config heightlight.toml --relief 0.1"}) {
    const CommandResult won = run_command(std::string("bake brick.png ") + order + " --json", folder);
    REQUIRE(won.exit_code == 0);
    CHECK(json::parse(read_text(folder / "out" / "brick_bake.json"))["map"]["relief"].get<double>() ==
          Approx(0.1));
  }
}

TEST_CASE("a wrong file of options is told in one line that names it", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 16", folder).exit_code == 0);
  const std::vector<std::pair<std::string, std::string>> faults{
      {"[bake]\nreleif = 0.1\n", "line 2: bake has no option 'releif'"},
      {"relief = 0.1\n", "line 1: 'relief' is in no section"},
      {"[brake]\n", "line 1: there is no command 'brake'"},
      {"[simulate]\nmaps = 1\n", "line 2: simulate has no option 'maps'"},
      {"[bake]\nmaps = ao,normal\n", "line 2: ',normal' is not expected here"},
      {"[bake]\nmaps = \"ao\n", "line 2: a quoted text has no closing quote"},
      {"[bake]\nrelief\n", "line 2: there is no '=' after 'relief'"},
      {"[bake]\nconfig = \"other.toml\"\n", "line 2: bake has no option 'config'"},
      {"[bake]\nrelief = 0.1\nrelief = 0.2\n", "line 3: 'relief' is given twice in section bake"},
      {"[bake]\nrelief = tall\n", "wrong.toml"}};
  for (const auto& [text, fault] : faults) {
    write_text(folder / "wrong.toml", text);
    const CommandResult run = run_command("bake brick.png -o out --config wrong.toml", folder);
    INFO(text << run.error);
    CHECK(run.exit_code == 2);
    CHECK(run.error.find("wrong.toml") != std::string::npos);
    CHECK(run.error.find(fault) != std::string::npos);
    CHECK(std::count(run.error.begin(), run.error.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }
  const CommandResult absent = run_command("bake brick.png -o out --config absent.toml", folder);
  CHECK(absent.exit_code == 2);
  CHECK(absent.error.find("absent.toml") != std::string::npos);
  write_text(folder / "right.toml", "[bake]\nrelief = 0.1\n");
  const CommandResult twice =
      run_command("bake brick.png -o out --config right.toml --config right.toml", folder);
  CHECK(twice.exit_code == 2);
  CHECK(twice.error == "heightlight: --config: give one file\n");
}

TEST_CASE("bash completes commands, options, their values and files", "[cli]") {
  const ScratchFolder folder;
  const CommandResult script = run_command("completion bash", folder);
  REQUIRE(script.exit_code == 0);
  write_text(folder / "heightlight.bash", script.out);
  CHECK(complete("heightlight sim", folder) == "simulate\n");
  CHECK(complete("heightlight bake --roughn", folder) == "--roughness\n");
  CHECK(complete("heightlight bake --skip", folder) == "--skip-existing\n");
  CHECK(complete("heightlight bake --format e", folder) == "exr\n");
  CHECK(complete("heightlight bake --depth ''", folder) == "8\n16\nhalf\nfloat\n");
  CHECK(complete("heightlight bake --format = p", folder) == "png\n");
  CHECK(complete("heightlight completion ''", folder) == "bash\nzsh\n");
  // Nothing of its own: readline then offers files.
  CHECK(script.out.find("complete -o default -F _heightlight heightlight") != std::string::npos);
  for (const char* words : {"heightlight bake br", "heightlight bake --albedo br", "heightlight bake -o br"})
    CHECK(complete(words, folder) == "\n");
  CHECK(run_command("completion fish", folder).exit_code == 2);
}

TEST_CASE("the completion of zsh names every option of every command", "[cli]") {
  const ScratchFolder folder;
  const std::string script = run_command("completion zsh", folder).out;
  CHECK(script.starts_with("#compdef heightlight\n"));
  CHECK(script.find("'*--format[") != std::string::npos);
  CHECK(script.find(":value:(png exr tif asc)'") != std::string::npos);
  if (std::system("command -v zsh > /dev/null") != 0) {
    WARN("SKIPPED: no zsh here to read its completion");
    return;
  }
  write_text(folder / "_heightlight", script);
  CHECK(std::system(("zsh -n '" + (folder / "_heightlight").string() + "'").c_str()) == 0);
}

}  // namespace heightlight
