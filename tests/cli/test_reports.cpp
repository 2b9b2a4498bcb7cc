#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "cli/noted_command.h"
#include "command.h"

// What `--report` writes; tests/report/ opens it in a browser.

namespace heightlight {
namespace {

using Catch::Contains;

/// The page, after what must hold of any.
std::string read_page(const std::filesystem::path& path) {
  REQUIRE(std::filesystem::exists(path));
  const std::string page = read_text(path);
  CHECK(page.size() < 10'000'000);
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(page.ends_with("</html>\n"));
  CHECK_THAT(page, Contains("default-src 'none'"));
  for (const char* part : {"What was asked", "What was reached", "What it cost", "How to repeat it"})
    CHECK_THAT(page, Contains(part));
  const std::size_t address = page.find("http://");  // a name, which nothing loads, is the only one
  CHECK(page.substr(address, 26) == "http://www.w3.org/2000/svg");
  CHECK(page.find("https://") == std::string::npos);
  return page;
}

/// All lines but those that tell what differs from one run to the next.
std::string without_cost(const std::string& page) {
  std::istringstream lines(page);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("cost\"") == std::string::npos) kept += line + '\n';
  }
  return kept;
}

void run(const std::string& arguments, const ScratchFolder& folder) {
  const CommandResult result = run_command(arguments, folder);
  INFO(arguments << ": " << result.error);
  REQUIRE(result.exit_code == 0);
}

}  // namespace

TEST_CASE("simulate, fit and dataset write reports", "[cli][report][slow]") {
  const ScratchFolder folder;
  run("synth cobbles --size 24 -o map.exr", folder);
  run("simulate map.exr -o out --relief 0.1 --report --quiet --threads 1", folder);
  const std::string page = read_page(folder / "out/report.html");
  CHECK_THAT(page, Contains("heightlight simulate map.exr -o out --relief 0.1 --report --quiet --threads 1"));
  CHECK_THAT(page, Contains("sky_view_factor.exr"));
  const nlohmann::json summary = nlohmann::json::parse(read_text(folder / "out/summary.json"));
  CHECK_THAT(page, Contains(summary["map"]["sha256"].get<std::string>()));
  CHECK(summary["files"].dump().find("report.html") != std::string::npos);

  SECTION("which are the same but for what it cost") {
    std::filesystem::rename(folder / "out", folder / "former");
    run("simulate map.exr -o out --relief 0.1 --report --quiet --threads 1", folder);
    CHECK(without_cost(read_page(folder / "out/report.html")) == without_cost(page));
  }
  SECTION("which a run without one takes away") {
    run("simulate map.exr -o out --relief 0.1 --quiet", folder);
    CHECK_FALSE(std::filesystem::exists(folder / "out/report.html"));
  }
  SECTION("of a fit") {
    run("fit out/curves.csv -o fit --report --quiet --bootstrap 20", folder);
    const std::string fitted = read_page(folder / "fit/report.html");
    CHECK_THAT(fitted, Contains("out/curves.csv"));
    CHECK_THAT(fitted, Contains("errors elsewhere will be larger"));  // one material
  }
  SECTION("of a dataset") {
    write_text(folder / "study.json",
               R"({"maps": [{"file": "map.exr"}, {"file": "absent.exr"}], "options": [{"bounces": 3}]})");
    CHECK(run_command("dataset study.json -o study --report --quiet", folder).exit_code == 1);
    const std::string dataset = read_page(folder / "study/report.html");
    CHECK_THAT(dataset, Contains("The runs that failed"));
    CHECK_THAT(dataset, Contains("absent.exr"));
    CHECK(run_command("dataset study.json -o study --report --shard 1/2", folder).exit_code == 2);
  }
}

TEST_CASE("bake writes a report of each map, named as its maps are", "[cli][report][slow]") {
  const ScratchFolder folder;
  run("synth cobbles --size 24 -o a.exr", folder);
  run("synth steps --size 24 -o b.exr", folder);
  run("bake a.exr b.exr -o maps --maps ao,bent-normal,multibounce,ao-n --albedo 0.2,0.5,0.7 --report --quiet",
      folder);
  CHECK_THAT(read_page(folder / "maps/a_report.html"), Contains("a_bent-normal.png"));
  read_page(folder / "maps/b_report.html");
  const std::string sidecar = read_text(folder / "maps/a_bake.json");
  CHECK_THAT(sidecar, Contains("a_report.html"));
  SECTION("skipped where it is there, made again where not") {
    const std::string again =
        "bake a.exr -o maps --maps ao,bent-normal,multibounce,ao-n --albedo 0.2,0.5,0.7 --report "
        "--skip-existing";
    CHECK_THAT(run_command(again, folder).out, Contains("0 baked, 1 skipped"));
    std::filesystem::remove(folder / "maps/a_report.html");
    CHECK_THAT(run_command(again, folder).out, Contains("1 baked"));
  }
  SECTION("window by window") {
    run("synth cobbles --size 96 -o c.tif", folder);
    run("bake c.tif -o maps --maps ao --out-of-core 64 --report --quiet", folder);
    read_page(folder / "maps/c_report.html");
  }
}

TEST_CASE("compare writes a report", "[cli][compare][report][slow]") {
  const ScratchFolder folder;
  run("synth cobbles --size 24 -o map.exr", folder);
  run("compare map.exr -o out --relief 0.1 --albedo 0.5 --report --quiet", folder);
  const std::string page = read_page(folder / "out/report.html");
  CHECK_THAT(page, Contains("What the closed forms err by"));
  CHECK_THAT(page, Contains("\"reference\":0"));
  CHECK(run_command("compare map.exr -o other --specular --report", folder).exit_code == 2);
}

TEST_CASE("command lines are quoted for a shell", "[cli][report]") {
  CHECK(shell_quoted("--albedo=0.5,0.2") == "--albedo=0.5,0.2");
  CHECK(shell_quoted("two words") == "'two words'");
  CHECK(shell_quoted("it's") == "'it'\\''s'");
  CHECK(shell_quoted("") == "''");
  CHECK(shell_quoted("#a0522d") == "'#a0522d'");
  CHECK(shell_quoted("a\nb'\x01\xff") == "$'a\\nb\\'\\001\\377'");
  // A shell reads them as they were.
  const ScratchFolder folder;
  for (const std::string name : {"<&\"'> $(x) \\", "line\nbreak'", "\xff\x01 1"}) {
    write_text(folder / "script",
               "printf %s " + shell_quoted(name) + " > '" + (folder / "out").string() + "'");
    REQUIRE(std::system(("bash '" + (folder / "script").string() + "'").c_str()) == 0);
    CHECK(read_text(folder / "out") == name);
  }
}

}  // namespace heightlight
