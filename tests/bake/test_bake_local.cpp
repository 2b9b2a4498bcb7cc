#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "bake/baked_files.h"
#include "bake/local_maps.h"
#include "bake/material.h"
#include "heightlight/error.h"
#include "heightmap/gaussian_mean.h"
#include "test_maps.h"

namespace heightlight {
namespace {

/// Waves along both axes: bumps and pits of the same curvature, whose relief is 0.02 on a width of 1.
Heightmap egg_box() {
  return make_map(64, 64, Boundary::tile, [](int row, int column) {
    const double wave = 2 * std::numbers::pi * 2 / 64;
    return 0.01 + 0.005 * (std::cos(wave * row) + std::cos(wave * column));
  });
}

BakeOptions options_with(std::vector<MaterialMap> maps) {
  BakeOptions options;
  options.maps = std::move(maps);
  return options;
}

TEST_CASE("curvature's parts add up, level .5 is flat, and the file says at what scale", "[bake]") {
  const ScratchFolder folder;
  BakeOptions options = options_with(
      {MaterialMap::curvature, MaterialMap::convexity, MaterialMap::concavity, MaterialMap::cavity});
  options.detail_scale = 0.02;
  bake_map(egg_box(), options, folder / "levels");
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  bake_map(egg_box(), options, folder / "floats");
  const auto real = [&](const char* map) {
    return read_by_oiio(folder / "floats" / (std::string("m_") + map + ".exr"));
  };
  const ReadTexture curvature = real("curvature");
  const ReadTexture convexity = real("convexity");
  const ReadTexture concavity = real("concavity");
  for (std::size_t i = 0; i < curvature.samples.size(); ++i) {
    CHECK(curvature.samples[i] == convexity.samples[i] - concavity.samples[i]);
    CHECK(std::min(convexity.samples[i], concavity.samples[i]) == 0);
  }
  const double wave = 2 * std::numbers::pi * 2;
  const double left = std::exp(-0.5 * wave * wave * 0.02 * 0.02);  // of the wave, by the Gaussian
  CHECK(curvature.at(0, 0, 0) == Approx(0.005 * wave * wave * left).epsilon(0.01));  // discretisation
  CHECK(curvature.at(16, 16, 0) == Approx(-0.005 * wave * wave * left).epsilon(0.01));
  CHECK(real("cavity").at(16, 16, 0) == Approx(-0.01 * (1 - left) / 0.02).epsilon(0.01));
  const ReadTexture levels = read_by_oiio(folder / "levels" / "m_curvature.png");
  CHECK(levels.at(0, 16, 0) == Approx(32768).margin(10));  // a saddle
  const nlohmann::json sidecar = read_sidecar(folder / "levels");
  CHECK(sidecar["detail"]["gaussian_standard_deviation"] == 0.02);
  const nlohmann::json& channel = sidecar["files"][0]["channels"][0];
  CHECK(channel["unit"] == "1/world length");
  CHECK(channel["value_of_level_0"].get<double>() == -channel["value_of_level_65535"].get<double>());
  CHECK(sidecar["files"][0]["definition"].get<std::string>().find("0.02 world units") != std::string::npos);
}

TEST_CASE("displacement is in the unit asked for, and none at the midlevel", "[bake]") {
  const ScratchFolder folder;
  BakeOptions options = options_with({MaterialMap::displacement});
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  options.midlevel = 0.25;
  bake_map(egg_box(), options, folder / "m");
  options.displacement_unit = DisplacementUnit::centimetre;
  bake_map(egg_box(), options, folder / "cm");
  CHECK(read_by_oiio(folder / "m" / "m_displacement.exr").at(0, 0, 0) == Approx(0.015).epsilon(1e-5));
  CHECK(read_by_oiio(folder / "cm" / "m_displacement.exr").at(0, 0, 0) == Approx(1.5).epsilon(1e-5));
  CHECK(read_by_oiio(folder / "cm" / "m_displacement.exr").at(16, 16, 0) == Approx(-0.5).epsilon(1e-5));
  const nlohmann::json sidecar = read_sidecar(folder / "cm");
  CHECK(sidecar["displacement"]["scale"].get<double>() == Approx(2).epsilon(1e-5));
  CHECK(sidecar["displacement"]["midlevel"] == 0.25);
  CHECK(sidecar["displacement"]["unit"] == "cm");
}

TEST_CASE("a normal's strength multiplies slopes, and is said not to be physical", "[bake]") {
  const ScratchFolder folder;
  BakeOptions options = options_with({MaterialMap::normal});
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  bake_map(egg_box(), options, folder / "own");
  options.normal_strength = 3;
  bake_map(egg_box(), options, folder / "strong");
  const ReadTexture own = read_by_oiio(folder / "own" / "m_normal.exr");
  const ReadTexture strong = read_by_oiio(folder / "strong" / "m_normal.exr");
  const auto slope = [](const ReadTexture& texture, int channel) {
    return texture.at(5, 9, channel) / texture.at(5, 9, 2);
  };
  CHECK(slope(strong, 0) == Approx(3 * slope(own, 0)).epsilon(1e-5));
  CHECK(slope(strong, 1) == Approx(3 * slope(own, 1)).epsilon(1e-5));
  CHECK(read_sidecar(folder / "own")["conventions"]["normal_is_physical"] == true);
  CHECK(read_sidecar(folder / "strong")["conventions"]["normal_is_physical"] == false);
  CHECK(read_sidecar(folder / "strong")["files"][0]["definition"].get<std::string>().find("not physical") !=
        std::string::npos);
}

TEST_CASE("maps of surroundings are found only where they are wanted", "[bake]") {
  const Surface surface = build_surface(egg_box());
  const LocalMaps none = find_local_maps(surface, options_with({MaterialMap::ao, MaterialMap::displacement}));
  CHECK(none.curvature.values.empty());
  CHECK(none.cavity.values.empty());
  const LocalMaps cavity = find_local_maps(surface, options_with({MaterialMap::cavity}));
  CHECK(cavity.curvature.values.empty());
  CHECK(cavity.cavity.size() == 64 * 64);
  CHECK(cavity.scale == Approx(0.0025));
  CHECK(kept_local_bytes(options_with({MaterialMap::convexity, MaterialMap::concavity})) == sizeof(float));
  BakeOptions flat = options_with({MaterialMap::cavity});
  flat.detail_scale = 0;
  CHECK_THROWS_AS(check_bake_options(flat), UsageError);
}

TEST_CASE("a sheet is drawn of what it needs, which is found for it, and stands among the files", "[bake]") {
  const ScratchFolder folder;
  BakeOptions options = options_with({MaterialMap::height});
  options.draw_sheet = [](const Material& material, const Albedo& albedo) {
    CHECK(material.results.sky_view_factor.size() == 64 * 64);
    CHECK(material.results.moments.first.size() == 64 * 64);
    CHECK(material.totals.size() == 1);
    CHECK(albedo.constant == std::vector<double>{0.5});
    return Image<Rgb8>(3, 2, Rgb8{1, 2, 3});
  };
  bake_map(egg_box(), options, folder.path());
  CHECK(baked_files("m", options) == std::vector<std::string>{"m_height.png", "m_sheet.png", "m_bake.json"});
  CHECK(read_by_oiio(folder / "m_sheet.png").width == 3);
  CHECK(read_sidecar(folder.path())["files"][1]["file"] == "m_sheet.png");
}

}  // namespace
}  // namespace heightlight
