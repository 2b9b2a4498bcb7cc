#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"

namespace heightlight {
namespace {

using Catch::Matchers::Contains;

const char* const kResults[] = {"models.json", "models.csv", "models.glsl", "models.hlsl", "fitted.svg",
                                "fitted.png",  "errors.svg", "errors.png",  "cubic.svg",   "cubic.png"};

nlohmann::json find_form(const nlohmann::json& forms, const std::string& name) {
  for (const nlohmann::json& form : forms) {
    if (form["name"] == name) return form;
  }
  return nullptr;
}

double rms_at(const nlohmann::json& forms, const std::string& name, std::size_t albedo) {
  return find_form(forms, name)["errors"][albedo]["rms"];
}

}  // namespace

TEST_CASE("fit judges forms texel by texel, on materials that it left out", "[cli][fit]") {
  const ScratchFolder folder;
  for (const std::string shape : {"brick", "cobbles", "fbm"}) {
    REQUIRE(run_command("synth " + shape + " -o " + shape + ".png --size 64", folder).exit_code == 0);
    REQUIRE(run_command("simulate " + shape + ".png -o " + shape +
                            " --relief 0.15 --save-bounces --error 0 --azimuths 16 --bounces 8 --quiet",
                        folder)
                .exit_code == 0);
  }
  for (const std::string threads : {"1", "2"}) {
    const CommandResult run = run_command("fit brick/curves.csv cobbles/curves.csv fbm/curves.csv -o out" +
                                              threads + " --threads " + threads + " --bootstrap 20",
                                          folder);
    INFO(run.error);
    REQUIRE(run.exit_code == 0);
    CHECK(run.error.empty());
    CHECK_THAT(run.out, Contains("notes_direct") && Contains("published") && Contains("why:") &&
                            Contains("floor of A"));
  }
  for (const char* name : kResults) {
    INFO(name);
    CHECK(std::filesystem::file_size(folder / "out1" / name) > 0);
    const std::string file = name;
    if (file.ends_with("svg") || file.ends_with("png")) continue;
    CHECK((read_text(folder / "out1" / name) == read_text(folder / "out2" / name)));
  }
  const nlohmann::json models = nlohmann::json::parse(read_text(folder / "out1" / "models.json"));
  CHECK(models["maps"].size() == 3);
  CHECK(models["cross_validation"]["materials"] == 3);
  const nlohmann::json& texels = models["cross_validation"]["per_texel"];
  // what theory asks of forms that are exact at albedo 1, and of those that know more than others
  CHECK(rms_at(texels, "seen_stored", 9) < 1e-5);
  CHECK(rms_at(texels, "seen_from_sky_refit", 9) < 1e-5);
  CHECK(rms_at(texels, "seen_stored", 6) < 1e-5);
  CHECK(rms_at(texels, "seen_stored", 4) < rms_at(texels, "seen_from_deep_refit", 4));
  CHECK(rms_at(texels, "seen_stored", 8) < rms_at(texels, "uniform_neighbourhood", 8));
  CHECK(rms_at(texels, "cubic", 9) > 0.01);
  CHECK(find_form(texels, "notes")["outside_domain"].get<double>() > 0);
  for (const nlohmann::json& form : texels) {
    for (const nlohmann::json& errors : form["errors"]) {
      CHECK(std::abs(errors["bias"].get<double>()) <= errors["rms"].get<double>() + 1e-12);
      CHECK(errors["rms"].get<double>() <= errors["max"].get<double>() + 1e-12);
    }
  }
  for (const nlohmann::json& family : models["families"]) {
    for (const nlohmann::json& parameter : family["parameters"]) {
      CHECK(parameter["low"].get<double>() <= parameter["high"].get<double>());
      CHECK(parameter["standard_error"].get<double>() > 0);
    }
  }
}

TEST_CASE("fit takes curves alone", "[cli][fit]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o brick.png --size 64", folder).exit_code == 0);
  REQUIRE(run_command("simulate brick.png -o brick --error 0 --azimuths 16 --bounces 8 --quiet", folder)
              .exit_code == 0);
  std::filesystem::copy(folder / "brick" / "curves.csv", folder / "alone.csv");
  const CommandResult run = run_command("fit alone.csv -o out --bootstrap 20", folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const nlohmann::json models = nlohmann::json::parse(read_text(folder / "out" / "models.json"));
  CHECK(models["maps"][0]["name"] == "alone");
  CHECK(models["cross_validation"]["per_texel"].empty());
  CHECK(find_form(models["cross_validation"]["per_bin"], "seen_from_sky_refit").is_object());
  CHECK(find_form(models["cross_validation"]["per_bin"], "seen_from_map_refit").is_null());
  CHECK(models["floors"].empty());
}

TEST_CASE("fit refuses what it cannot use, and leaves nothing behind", "[cli][fit]") {
  const ScratchFolder folder;
  write_text(folder / "bad.csv", "ao_kind,bin\n");
  write_text(folder / "curves.csv", "not,a,table\n1,2,3\n");
  const auto refuses = [&](const std::string& arguments, int exit_code, const std::string& fault) {
    const CommandResult run = run_command("fit " + arguments, folder);
    INFO(arguments << ": " << run.error);
    CHECK(run.exit_code == exit_code);
    CHECK_THAT(run.error, Contains(fault));
    CHECK(std::count(run.error.begin(), run.error.end(), '\n') == 1);
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  };
  refuses("absent.csv -o out", 1, "absent.csv: no such file");
  refuses("bad.csv -o out", 1, "bad.csv: has no column 'ao_lo'");
  refuses("curves.csv -o out", 1, "curves.csv: has no column 'ao_kind'");
  refuses("bad.csv", 2, "--output");
  refuses("-o out", 2, "CURVES");
  refuses("bad.csv -o out --bootstrap 3", 2, "--bootstrap 3");
}

}  // namespace heightlight
