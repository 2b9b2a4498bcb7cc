#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "command.h"

namespace heightlight {
namespace {

using Catch::Matchers::Contains;

const char* const kResults[] = {"models.json", "models.csv", "ratios.csv", "models.glsl",    "models.hlsl",
                                "fitted.svg",  "fitted.png", "errors.svg", "errors.png",     "bounces.svg",
                                "bounces.png", "ratios.svg", "ratios.png", "saturation.svg", "saturation.png",
                                "cubic.svg",   "cubic.png"};

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
                            Contains("floor of A") && Contains("is tau one number?"));
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

TEST_CASE("constants fitted to two or three maps are bounded, and no worse there than the defaults",
          "[cli][fit]") {
  const ScratchFolder folder;
  for (const std::string shape : {"brick", "cobbles", "fbm", "bowl"}) {
    REQUIRE(run_command("synth " + shape + " -o " + shape + ".png --size 64", folder).exit_code == 0);
    REQUIRE(run_command("simulate " + shape + ".png -o " + shape +
                            " --relief 0.15 --save-bounces --error 0 --azimuths 16 --bounces 8 --quiet",
                        folder)
                .exit_code == 0);
  }
  for (const std::string maps : {"brick cobbles", "brick fbm cobbles", "bowl brick", "fbm bowl"}) {
    std::string curves;
    std::istringstream names(maps);
    for (std::string name; names >> name;) curves += name + "/curves.csv ";
    REQUIRE(run_command("fit " + curves + "-o out --bootstrap 20 --quiet", folder).exit_code == 0);
    const nlohmann::json models = nlohmann::json::parse(read_text(folder / "out/models.json"));
    for (const nlohmann::json& family : models["families"]) {
      if (!family["parameters"][0].contains("default")) continue;
      INFO(maps << ": " << family["name"]);
      // The shader has these constants, and asks for the same t and s as the defaults do.
      CHECK(family["rms"].get<double>() <= 1.001 * family["rms_as_default"].get<double>());
      for (const nlohmann::json& parameter : family["parameters"])
        CHECK(std::abs(parameter["value"].get<double>()) < 3);
    }
  }
}

TEST_CASE("fit judges and emits a user's own form", "[cli][fit][user-form]") {
  const ScratchFolder folder;
  for (const std::string shape : {"brick", "fbm"}) {
    REQUIRE(run_command("synth " + shape + " -o " + shape + ".png --size 64", folder).exit_code == 0);
    REQUIRE(run_command("simulate " + shape + ".png -o " + shape +
                            " --relief 0.15 --save-bounces --error 0 --azimuths 16 --bounces 8 --quiet",
                        folder)
                .exit_code == 0);
  }
  const std::string fit = "fit brick/curves.csv fbm/curves.csv --bootstrap 20 --quiet ";
  write_text(folder / "forms.txt", "# remarks are left out\nstored = A + rho*(1 - A)*n/(1 - rho*(1 - n))\n");
  const CommandResult run =
      run_command(fit + "-o out --forms forms.txt --form 'mine = A/(1 - rho*(1 - A)^k)'", folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.error.empty());
  const nlohmann::json models = nlohmann::json::parse(read_text(folder / "out/models.json"));
  const nlohmann::json& texels = models["cross_validation"]["per_texel"];
  for (std::size_t albedo = 0; albedo < 9; ++albedo)
    CHECK(rms_at(texels, "stored", albedo) == Approx(rms_at(texels, "seen_stored", albedo)));
  CHECK(rms_at(texels, "mine_refit", 4) < rms_at(texels, "direct", 4));
  CHECK(find_form(texels, "mine_refit")["fitted_without_the_material"] == true);
  CHECK_THAT(read_text(folder / "out/models.glsl"),
             Contains("float heightlight_mine(float sky, float rho)") &&
                 Contains("vec3 heightlight_stored(float sky, float seen, vec3 albedo)"));
  const auto refuses = [&](const std::string& form, int exit_code, const char* fault) {
    const CommandResult refused = run_command(fit + "-o no --form '" + form + "'", folder);
    CHECK(refused.exit_code == exit_code);
    CHECK_THAT(refused.error, Contains(fault));
    CHECK_FALSE(std::filesystem::exists(folder / "no"));
  };
  refuses("mine = A/(1 - rho", 2, "--form 'mine = A/(1 - rho': column 18: a ')' is missing");
  refuses("mine = A*alhpa", 2, "'alhpa' is not known");
  refuses("mine = k/(A - A)", 1, "the fit of mine: the form is not finite at A = ");
  refuses("mine = 1/(A - A)", 2, "--form mine: has no finite value on any of the maps");
  const CommandResult partly = run_command(fit + "-o partly --form 'mine = sqrt(alpha - 0.5)'", folder);
  CHECK(partly.exit_code == 0);
  CHECK_THAT(partly.error,
             Contains("warning: form mine has no finite value on ") && Contains("% of the texels"));
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
