// Maps that terrain science knows: horizons by the compass, sky view factors and openness by their names.

#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "baked_files.h"
#include "heightlight/error.h"
#include "test_maps.h"

namespace heightlight {
namespace {

BakeOptions float_maps(std::vector<MaterialMap> maps) {
  BakeOptions options;
  options.maps = std::move(maps);
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  return options;
}

/// A wall on the right, in the east, and a lower one on top, in the north.
Heightmap two_walls(Boundary boundary) {
  return make_map(33, 33, boundary, [](int row, int column) {
    return column == 32 ? 0.6 : row == 0 ? 0.3 : 0.0;
  });
}

TEST_CASE("horizons count clockwise from north on open maps, from x toward y on tiles", "[bake][terrain]") {
  const ScratchFolder folder;
  const bool y_down = GENERATE(false, true);
  BakeOptions options = float_maps({MaterialMap::horizon});
  options.y_down = y_down;
  const auto bake = [&](const char* name, Boundary boundary, std::optional<AzimuthConvention> convention) {
    options.azimuth_convention = convention;
    bake_map(two_walls(boundary), options, folder / name);
    return read_by_oiio(folder / name / "m_horizon.exr");
  };
  const ReadTexture open = bake("open", Boundary::open, {});
  const ReadTexture north = bake("north", Boundary::open, AzimuthConvention::north);
  const ReadTexture math = bake("math", Boundary::open, AzimuthConvention::math);
  const ReadTexture tile = bake("tile", Boundary::tile, {});
  const ReadTexture tile_math = bake("tile-math", Boundary::tile, AzimuthConvention::math);
  CHECK(open == north);
  CHECK(tile == tile_math);
  const double east = std::atan(0.6 / (16.0 / 33));
  const double up = std::atan(0.3 / (16.0 / 33));
  CHECK(double{north.at(16, 16, 0)} == Approx(up).epsilon(0.05));    // discretisation
  CHECK(double{north.at(16, 16, 1)} == Approx(east).epsilon(0.05));  // discretisation
  CHECK(double{math.at(16, 16, 0)} == Approx(east).epsilon(0.05));
  CHECK(double{math.at(16, 16, y_down ? 3 : 1)} == Approx(up).epsilon(0.05));
  const std::string quantity = read_sidecar(folder / "north")["files"][0]["channels"][1]["quantity"];
  CHECK(quantity == "toward 90 degrees clockwise from north");
  CHECK(read_sidecar(folder / "tile")["conventions"]["azimuths"] == "from x toward y");
}

TEST_CASE("as many as 360 horizons are baked", "[bake][terrain]") {
  const ScratchFolder folder;
  BakeOptions options = float_maps({MaterialMap::horizon});
  options.horizon_azimuths = 360;
  bake_map(make_synth_map("fbm", 12, Boundary::open, 0.2), options, folder.path());
  CHECK(read_by_oiio(folder / "m_horizon.exr").channels == 360);
  const nlohmann::json channels = read_sidecar(folder.path())["files"][0]["channels"];
  CHECK(channels[1]["quantity"] == "toward 1 degrees clockwise from north");
  options.horizon_azimuths = 361;
  CHECK_THROWS_AS(check_bake_options(options), UsageError);
}

TEST_CASE("definitions are baked by their names, with their formulas and errors", "[bake][terrain]") {
  const ScratchFolder folder;
  std::vector<MaterialMap> maps{MaterialMap::ao};
  for (const MaterialMapName& entry : material_maps()) {
    if (definition_of(entry.map)) maps.push_back(entry.map);
  }
  REQUIRE(maps.size() == 1 + sky_definitions().size());
  bake_map(make_synth_map("fbm", 48, Boundary::open, 0.3), float_maps(maps), folder.path());
  const nlohmann::json sidecar = read_sidecar(folder.path());
  const ReadTexture ao = read_by_oiio(folder / "m_ao.exr");
  CHECK(read_by_oiio(folder / "m_svf-tilted.exr") == ao);
  const ReadTexture walls = read_by_oiio(folder / "m_terrain-view-factor.exr");
  for (std::size_t i = 0; i < ao.samples.size(); ++i) REQUIRE(walls.samples[i] == 1 - ao.samples[i]);
  for (std::size_t i = 0; i < sky_definitions().size(); ++i) {
    const SkyDefinitionFacts& facts = sky_definitions()[i];
    INFO(facts.name);
    const std::string text = sidecar["files"][i + 1]["definition"];
    CHECK(text.find(facts.formula) != std::string::npos);
    CHECK(sidecar["files"][i + 1]["channels"][0]["unit"] == facts.unit);
    const double error = sidecar["errors"][std::string(facts.name) + "_rmse"];
    CHECK(error > 0);
    CHECK(error < 1.15 * 0.002);  // discretisation: what is asked for
  }
}

TEST_CASE("ground below the horizontal darkens slopes, and is told", "[bake][terrain]") {
  const ScratchFolder folder;
  const Heightmap slope =
      make_map(24, 24, Boundary::open, [](int row, int column) { return (0.8 * column - 0.6 * row) / 24; });
  BakeOptions options = float_maps({MaterialMap::ao, MaterialMap::multibounce, MaterialMap::svf_horizontal});
  options.below = BelowHorizontal::ground;
  bake_map(slope, options, folder.path());
  const double expected = (1 + std::sqrt(0.5)) / 2;
  for (const char* name : {"m_ao.exr", "m_multibounce.exr"})  // a plane sees nothing of itself
    CHECK(double{read_by_oiio(folder / name).at(12, 12, 0)} ==
          Approx(expected).margin(4e-3));  // discretisation
  const nlohmann::json sidecar = read_sidecar(folder.path());
  const std::string lit = sidecar["files"][0]["definition"];
  const std::string level = sidecar["files"][2]["definition"];
  CHECK(lit.ends_with("nothing shines below the horizontal"));
  CHECK_FALSE(level.ends_with("nothing shines below the horizontal"));
  options.maps = {MaterialMap::ao_n};
  CHECK_THROWS_AS(check_bake_options(options), UsageError);
}

TEST_CASE("a light of one's own is baked beside its bounces, in its channels", "[bake][terrain]") {
  const ScratchFolder folder;
  BakeOptions options = float_maps({MaterialMap::direct, MaterialMap::multibounce});
  options.albedo = {.constant = {0}};
  options.light_channels = 3;
  options.find_light = [](const Surface& surface) {
    GivenIrradiance light{.description = "three lamps"};
    for (const double brightness : {0.25, 0.5, 2.0})
      light.channels.emplace_back(surface.map.height.size(), brightness);
    return light;
  };
  options.packed = {{"packed", {{MaterialMap::direct, 2, 0}}}};
  bake_map(two_walls(Boundary::open), options, folder.path());
  const ReadTexture direct = read_by_oiio(folder / "m_direct.exr");
  const ReadTexture total = read_by_oiio(folder / "m_multibounce.exr");
  REQUIRE(direct.channels == 3);
  CHECK(direct.at(5, 7, 0) == 0.25F);
  CHECK(direct.at(5, 7, 2) == 2);
  CHECK(total.samples == direct.samples);  // black ground: identity
  CHECK(read_by_oiio(folder / "m_packed.exr").at(5, 7, 0) == 2);
  CHECK(read_sidecar(folder.path())["light"]["of"] == "three lamps");
  options.packed = {{"packed", {{MaterialMap::direct, 3, 0}}}};
  CHECK_THROWS_AS(bake_map(two_walls(Boundary::open), options, folder.path()), UsageError);
  options.light_channels = 0;
  options.packed = {};
  CHECK_THROWS_WITH(bake_map(two_walls(Boundary::open), options, folder.path()),
                    Catch::Contains("direct wants a light"));
}

}  // namespace
}  // namespace heightlight
