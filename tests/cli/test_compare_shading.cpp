#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"

namespace heightlight {
namespace {

using Catch::Contains;

TEST_CASE("compare --specular and --directional write their reports, tables, pictures and evidence",
          "[cli][slow][compare][gloss]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 24", folder).exit_code == 0);
  const CommandResult specular =
      run_command("compare map.png -o out --specular --roughness 0.2 --view 30,50", folder);
  INFO(specular.error);
  REQUIRE(specular.exit_code == 0);
  const CommandResult directional = run_command("compare map.png -o out --directional", folder);
  INFO(directional.error);
  REQUIRE(directional.exit_code == 0);
  for (const char* name : {"specular.md", "specular.csv", "specular.png", "specular.json", "directional.md",
                           "directional.csv", "directional.png", "directional.json", "cone_forms.csv"})
    CHECK(std::filesystem::file_size(folder / (std::string("out/") + name)) > 400);
  const nlohmann::json json = nlohmann::json::parse(read_text(folder / "out/specular.json"));
  CHECK(json["truth"].size() == 1);
  CHECK(json["truth"][0]["roughness"] == 0.2);
  CHECK(json["truth"][0]["rmse"].get<double>() < 0.05);
  CHECK(json["files"].size() == 3);
  CHECK_THAT(read_text(folder / "out/specular.md"), Contains("0.2, 50°") && Contains("GTSO, table of 16^4"));
  CHECK_THAT(read_text(folder / "out/directional.md"), Contains("low-sun") && Contains("triple product"));
}

TEST_CASE("compare --specular and --directional refuse what they cannot use", "[cli][slow][compare][gloss]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 16", folder).exit_code == 0);
  REQUIRE(run_command("specular-table -o table.ktx --side 4", folder).exit_code == 0);
  const auto refused = [&](const std::string& options, int exit_code) {
    const CommandResult run = run_command("compare map.png -o out " + options, folder);
    INFO(options << ": " << run.error);
    CHECK(run.exit_code == exit_code);
    CHECK(std::count(run.error.begin(), run.error.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
    return run.error;
  };
  for (const char* roughness : {"0", "1.5", "0.2,-1", "rough"})
    CHECK_THAT(refused(std::string("--specular --roughness ") + roughness, 2), Contains("--roughness"));
  for (const char* view : {"10,-5", "10,0", "10,95", "10", "up"})
    CHECK_THAT(refused(std::string("--specular --view ") + view, 2), Contains("--view"));
  std::filesystem::resize_file(folder / "table.ktx", std::filesystem::file_size(folder / "table.ktx") - 3);
  CHECK_THAT(refused("--specular --table table.ktx", 1), Contains("table.ktx: holds"));
  CHECK_THAT(refused("--specular --table map.png", 1), Contains("map.png: is no KTX texture"));
  CHECK_THAT(refused("--directional --sky map.png", 1), Contains("map.png"));
  refused("--directional --specular", 2);
  refused("--directional --terrain", 2);
  refused("--specular --sky map.exr", 2);
  refused("--roughness 0.2", 2);
}

TEST_CASE("bake makes specular occlusion with its shaders and its table, and refuses bad gloss",
          "[cli][bake][gloss]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o map.png --size 24", folder).exit_code == 0);
  const std::string bake = "bake map.png -o out --maps specular-occlusion ";
  const auto refused = [&](const std::string& options) {
    const CommandResult run = run_command(bake + options, folder);
    INFO(options << ": " << run.error);
    CHECK(run.exit_code == 2);
    CHECK(std::count(run.error.begin(), run.error.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
    return run.error;
  };
  CHECK_THAT(refused("--roughness 0"), Contains("--roughness 0"));
  CHECK_THAT(refused("--view 30,-10"), Contains("--view 30,-10"));
  CHECK_THAT(refused("--below-horizontal ground"), Contains("--below-horizontal ground"));
  REQUIRE(run_command(bake + "--roughness 0.3 --view 90,60", folder).exit_code == 0);
  const nlohmann::json json = nlohmann::json::parse(read_text(folder / "out/map_bake.json"));
  CHECK(json["gloss"]["roughness_ggx_alpha"] == 0.3);
  CHECK(json["gloss"]["view"][0].get<double>() == Approx(0.5));
  CHECK(json["errors"]["specular_occlusion_rmse"].get<double>() > 0);
  CHECK_THAT(read_text(folder / "out/specular-occlusion.glsl"),
             Contains("heightlight_horizon_occlusion") && Contains("vec4 slopes3"));
  CHECK_THAT(read_text(folder / "out/specular-occlusion.hlsl"), Contains("float4 heightlight_table_place"));
  CHECK(std::filesystem::file_size(folder / "out/gtso.ktx") > 65536);
  // What is there already is found again, and other gloss is not taken for it.
  const auto baked_again = [&](const std::string& options) {
    return run_command(bake + options + " --skip-existing", folder).out;
  };
  CHECK_THAT(baked_again("--roughness 0.3 --view 90,60"), Contains("0 baked, 1 skipped"));
  CHECK_THAT(baked_again("--roughness 0.4 --view 90,60"), Contains("1 baked, 0 skipped"));
}

}  // namespace
}  // namespace heightlight
