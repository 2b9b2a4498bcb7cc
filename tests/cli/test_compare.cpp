#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "command.h"
#include "files/image_file.h"
#include "heightlight/image.h"
#include "write_samples.h"

namespace heightlight {
namespace {

std::vector<std::vector<std::string>> read_table(const std::filesystem::path& path) {
  std::vector<std::vector<std::string>> table;
  std::istringstream lines(read_text(path));
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& fields = table.emplace_back();
    std::istringstream cells(line + ",");
    for (std::string cell; std::getline(cells, cell, ',');) fields.push_back(cell);
  }
  return table;
}

TEST_CASE("compare writes its table, report, plots and pictures, and errors that do not depend on threads",
          "[cli][compare][slow]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth cobbles -o map.png --size 32", folder).exit_code == 0);
  const CommandResult one = run_command("compare map.png -o one --albedo 0.3,0.8,0.8 --threads 1", folder);
  INFO(one.error);
  REQUIRE(one.exit_code == 0);
  REQUIRE(run_command("compare map.png -o two --albedo 0.3,0.8,0.8 --threads 2 --quiet", folder).exit_code ==
          0);
  for (const char* name :
       {"compare.csv", "compare.json", "report.md", "forms.svg", "forms.png", "pareto.svg", "pareto.png",
        "errors.png", "total_errors.png", "showtime.png", "sky_light.png", "directions.png"}) {
    CHECK(std::filesystem::file_size(folder / (std::string("one/") + name)) > 500);
  }
  const auto pictures = std::filesystem::directory_iterator(folder / "one");
  CHECK(std::count_if(begin(pictures), end(pictures), [](const auto& entry) {
          return entry.path().filename().string().starts_with("error_");
        }) >= 8);
  std::vector<std::vector<std::string>> table = read_table(folder / "one/compare.csv");
  std::vector<std::vector<std::string>> other = read_table(folder / "two/compare.csv");
  REQUIRE(table.size() > 100);
  REQUIRE(table.size() == other.size());
  CHECK(table[0] == std::vector<std::string>{"method", "parameters", "quantity", "seconds", "core_seconds",
                                             "samples_per_texel", "rmse", "bias", "p99", "max", "psnr"});
  std::map<std::string, int> quantities;
  for (std::size_t i = 1; i < table.size(); ++i) {
    REQUIRE(table[i].size() == 11);
    ++quantities[table[i][2]];
    CHECK(std::stod(table[i][4]) > 0);
    table[i][3] = table[i][4] = other[i][3] = other[i][4] = "";  // times differ
    CHECK(table[i] == other[i]);
  }
  for (const char* quantity : {"sky_view_factor", "ambient_occlusion", "bent_normal_deg",
                               "two_tone_irradiance", "total_irradiance_0.3", "total_irradiance_0.8"}) {
    INFO(quantity);
    CHECK(quantities[quantity] > 0);
  }
  const std::string report = read_text(folder / "one/report.md");
  CHECK(report.find("Which form is best, on exact AO?") < report.find("## The reference"));
  CHECK(report.find("GTAO as games run it") < report.find("## The reference"));
  CHECK(report.find("The cheapest method for each error: sky_view_factor") != std::string::npos);
  CHECK(report.find("nan") == std::string::npos);
  const nlohmann::json evidence = nlohmann::json::parse(read_text(folder / "one/compare.json"));
  CHECK(evidence["map"]["width"] == 32);
  CHECK(evidence["reference"]["checked"]["receivers"] == 256);
  CHECK(evidence["visibility"]["checked"]["total_rmse_by_albedo"].size() == 3);
  CHECK(evidence["memory"]["estimated_bytes"].get<std::uint64_t>() > 0);
  std::map<std::string, int> groups;
  for (const nlohmann::json& line : evidence["answer"]) {
    ++groups[line["ao"].get<std::string>()];
    REQUIRE(line["errors"].size() == 3);
    CHECK(line["errors"][1]["rmse"] == line["errors"][2]["rmse"]);  // both at 0.8
    if (line["ao"] == "exact AO" && line["form"] == "seen_stored") CHECK(line["errors"][1]["rmse"] < 0.01);
    if (line["form"] != "notes_guarded") CHECK(line["outside_domain"] == 0);
  }
  CHECK(groups["exact AO"] == 6);
  for (const char* role : {"GTAO as games run it", "GTAO converged", "horizon walk"})
    CHECK(groups[role] == 5);
}

TEST_CASE("compare judges direct irradiance under a user's sky", "[cli][compare][slow]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 24", folder).exit_code == 0);
  // Light from +x alone, in one of four columns.
  write_samples<float>(folder / "east.exr", 4, 2, {"Y"}, {0, 0, 0, 5, 0, 0, 0, 5});
  const CommandResult run =
      run_command("compare map.png -o out --sky east.exr --albedo 0.5 --azimuths 32 --quiet", folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(nlohmann::json::parse(read_text(folder / "out/compare.json"))["sky"]["quantity"] == "sky_irradiance");
  CHECK_THAT(read_text(folder / "out/report.md"), Contains("Direct light of the sky east.exr"));
  std::map<std::string, double> least;
  for (const std::vector<std::string>& row : read_table(folder / "out/compare.csv")) {
    if (row[2] != "sky_irradiance") continue;
    const double rmse = std::stod(row[6]);
    const auto known = least.find(row[0]);
    least[row[0]] = known == least.end() ? rmse : std::min(rmse, known->second);
  }
  CHECK(least.count("ssdo") == 1);
  CHECK(least.count("gtao") == 1);
  CHECK(least["exact AO"] > 0.001);
  CHECK(least["exact AO"] < 0.4);
  const CommandResult bad = run_command("compare map.png -o out --sky map.png --quiet", folder);
  CHECK(bad.exit_code == 1);
  CHECK_THAT(bad.error, Contains("map.png: a sky wants radiance"));
  const CommandResult absent = run_command("compare map.png -o out --sky absent.exr --quiet", folder);
  CHECK(absent.exit_code == 1);
  CHECK_THAT(absent.error, Contains("absent.exr: no such file"));
}

TEST_CASE("compare fits and judges a user's own form", "[cli][compare][user-form][slow]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 32", folder).exit_code == 0);
  const CommandResult run = run_command(
      "compare map.png -o out --albedo 0.3,0.6 --quiet --form 'mine = A/(1 - rho*(1 - A)^k)' "
      "--form 'fixed = A/(1 - rho*(1 - A))' --form 'holes = sqrt(A - 0.5)'",
      folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json evidence = nlohmann::json::parse(read_text(folder / "out/compare.json"));
  CHECK(run.error.find("warning: map.png: form holes has no finite value on ") != std::string::npos);
  CHECK(run.error.find("form mine") == std::string::npos);
  const nlohmann::json& mine = evidence["own_forms"][0];
  CHECK(mine["name"] == "mine");
  CHECK(mine["constants"]["k"] > 0.5);
  CHECK(mine["rmse"].get<double>() <=
        evidence["own_forms"][1]["rmse"].get<double>() + 1e-9);  // it fits to that
  CHECK(mine["rmse_on_halves_left_out"] > 0);
  std::map<std::string, nlohmann::json> exact;
  for (const nlohmann::json& line : evidence["answer"]) {
    if (line["ao"] == "exact AO") exact[line["form"].get<std::string>()] = line;
  }
  CHECK(exact["fixed"]["errors"] == exact["uniform_neighbourhood"]["errors"]);
  CHECK(exact["holes"]["outside_domain"] > 0.05);
  CHECK(read_text(folder / "out/report.md").find("`mine = A/(1 - rho*(1 - A)^k), k = ") != std::string::npos);
  const std::vector<std::vector<std::string>> table = read_table(folder / "out/compare.csv");
  CHECK(std::count_if(table.begin(), table.end(),
                      [](const std::vector<std::string>& row) { return row[1].ends_with("; mine"); }) > 20);
}

TEST_CASE("compare takes a map with holes, an image as albedo, and a level map", "[cli][compare][slow]") {
  const ScratchFolder folder;
  std::string grid = "ncols 12\nnrows 10\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9\n";
  for (int i = 0; i < 120; ++i) grid += i % 17 == 3 ? "-9 " : std::to_string(i * i % 23) + " ";
  write_text(folder / "holes.asc", grid + "\n");
  Map albedo(12, 10);
  for (std::size_t i = 0; i < albedo.size(); ++i) albedo.values[i] = 0.01F * static_cast<float>(i % 80);
  write_float_image(folder / "albedo.exr", {{"Y", &albedo}});
  write_png16(folder / "level.png", Image<std::uint16_t>(8, 8, 77));
  const CommandResult holes = run_command("compare holes.asc -o out --albedo albedo.exr --quiet", folder);
  INFO(holes.error);
  CHECK(holes.exit_code == 0);
  CHECK(read_text(folder / "out/compare.csv").find("total_irradiance_map") != std::string::npos);
  CHECK(read_text(folder / "out/compare.csv").find("nan") == std::string::npos);
  CHECK(run_command("compare level.png -o level --quiet", folder).exit_code == 0);
}

TEST_CASE("compare refuses what makes no sense, and leaves nothing behind", "[cli][compare]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.png --size 16", folder).exit_code == 0);
  const auto which = GENERATE(std::pair{"compare map.png -o out --azimuths 7", 2},
                              std::pair{"compare map.png -o out --albedo 1.5", 2},
                              std::pair{"compare map.png -o out --albedo .1,.2,.3,.4,.5,.6,.7,.8,.9", 2},
                              std::pair{"compare map.png -o out --form 'm = A +'", 2},
                              std::pair{"compare map.png -o out --form 'm = 1/(A - A)'", 2},
                              std::pair{"compare map.png -o out --form 'm = k/(A - A)'", 1},
                              std::pair{"compare map.png -o out --memory 10k", 1},
                              std::pair{"compare absent.png -o out", 1}, std::pair{"compare map.png", 2});
  const CommandResult result = run_command(which.first, folder);
  INFO(which.first << ": " << result.error);
  CHECK(result.exit_code == which.second);
  CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
  CHECK(folder.entry_count() == 1);
}

}  // namespace
}  // namespace heightlight
