#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "command.h"
#include "files/image_file.h"
#include "results.h"

namespace heightlight {
namespace {

/// Some lit hills, `hill.exr`.
void make_hills(const ScratchFolder& folder) {
  REQUIRE(run_command("synth fbm -o hill.exr --size 32", folder).exit_code == 0);
}

TEST_CASE("under the sun, simulate finds the total of its light, and curves of an even sky's",
          "[cli][light]") {
  const ScratchFolder folder;
  make_hills(folder);
  const std::string simulate = "simulate hill.exr --boundary open --relief 0.3 --bounces 3 --albedo 0.8 -o ";
  REQUIRE(run_command(simulate + "sky", folder).exit_code == 0);
  REQUIRE(run_command(simulate + "sun --sun 120,35", folder).exit_code == 0);
  const Picture direct = read_picture(folder / "sun" / "irradiance_direct.exr");
  const Picture total = read_picture(folder / "sun" / "irradiance_total.exr");
  double brightest = 0;
  for (std::size_t i = 0; i < direct.values.size(); ++i) {
    CHECK(total.values[i] >= direct.values[i]);
    brightest = std::max(brightest, double{direct.values[i]});
  }
  CHECK(brightest <= 1);
  CHECK(brightest > 0.7);
  const nlohmann::json summary = read_summary(folder / "sun");
  const nlohmann::json& audit = summary["energy_audit"][0];
  CHECK(audit["absorbed"].get<double>() + audit["escaped"].get<double>() == Approx(1).margin(5e-3));
  CHECK(summary["light"]["of_total"].get<std::string>().starts_with("sun at 120, 35 degrees"));
  CHECK(read_text(folder / "sun" / "curves.csv") == read_text(folder / "sky" / "curves.csv"));
  CHECK_FALSE(std::filesystem::exists(folder / "sky" / "irradiance_direct.exr"));
}

TEST_CASE("light of one's own that is the sky's bounces like it", "[cli][light]") {
  const ScratchFolder folder;
  make_hills(folder);
  const std::string bake = "bake hill.exr --relief 0.3 --format exr --depth float --albedo 0.8 --maps ";
  REQUIRE(run_command(bake + "ao,multibounce -o sky", folder).exit_code == 0);
  REQUIRE(run_command(bake + "direct,multibounce --direct sky/hill_ao.exr -o own", folder).exit_code == 0);
  CHECK(read_picture(folder / "own" / "hill_direct.exr").values ==
        read_picture(folder / "sky" / "hill_ao.exr").values);
  const Picture own = read_picture(folder / "own" / "hill_multibounce.exr");
  const Picture sky = read_picture(folder / "sky" / "hill_multibounce.exr");
  double squares = 0;
  for (std::size_t i = 0; i < own.values.size(); ++i) squares += std::pow(own.values[i] - sky.values[i], 2);
  CHECK(std::sqrt(squares / static_cast<double>(own.values.size())) < 0.004);  // of both errors
}

TEST_CASE("lights that cannot be are refused in a line, and nothing is written", "[cli][light]") {
  const ScratchFolder folder;
  make_hills(folder);
  Map dark(32, 32, 0.5F);
  dark(3, 4) = -1;
  write_float_image(folder / "negative.exr", {{"Y", &dark}});
  dark(3, 4) = std::nanf("");
  write_float_image(folder / "nan.exr", {{"Y", &dark}});
  write_png16(folder / "levels.png", Image<std::uint16_t>(32, 32));
  const Map small(16, 8, 1.0F);
  write_float_image(folder / "small.exr", {{"Y", &small}});
  struct WrongLight {
    const char* options;
    int exit_code;
    const char* fault;
  };
  const WrongLight wrong =
      GENERATE(values<WrongLight>({{"--sun 120", 2, "--sun 120: must be azimuth and elevation"},
                                   {"--sun 120,91", 2, "--sun: must stand above the horizontal"},
                                   {"--sun 120,30 --sky overcast", 2, "excludes"},
                                   {"--sky none.exr", 1, "none.exr: no such file"},
                                   {"--sky hill.exr", 1, "hill.exr: "},
                                   {"--direct negative.exr", 1, "negative.exr: has direct irradiance"},
                                   {"--direct nan.exr", 1, "nan.exr: has direct irradiance"},
                                   {"--direct levels.png", 1, "levels.png: holds integers"},
                                   {"--direct small.exr", 1, "small.exr: the direct irradiance is 16 × 8"}}));
  for (const char* command : {"bake hill.exr --maps multibounce", "simulate hill.exr"}) {
    INFO(command << ' ' << wrong.options);
    const CommandResult result =
        run_command(std::string(command) + " -o out --quiet " + wrong.options, folder);
    CHECK(result.exit_code == wrong.exit_code);
    CHECK_THAT(result.error, Catch::Contains(wrong.fault));
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
  }
}

}  // namespace
}  // namespace heightlight
