#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "bake/baked_files.h"
#include "bake/blue_noise.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/error.h"
#include "remedy.h"
#include "test_maps.h"

namespace heightlight {
namespace {

/// Under an even sky.
std::vector<MaterialMap> all_maps() {
  std::vector<MaterialMap> maps;
  for (const MaterialMapName& entry : material_maps()) {
    if (entry.map != MaterialMap::direct) maps.push_back(entry.map);
  }
  return maps;
}

std::set<std::string> names_in(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

TEST_CASE("bake writes the files that it names, and nothing else", "[bake]") {
  const ScratchFolder folder;
  BakeOptions options;
  options.maps = GENERATE(std::vector<MaterialMap>{MaterialMap::normal}, all_maps());
  options.packed = {
      {"packed", {{MaterialMap::ao, 0, 0}, {std::nullopt, 0, 0.5}, {MaterialMap::normal, 1, 0}}}};
  bake_map(make_synth_map("brick", 48, Boundary::tile, 0.1), options, folder.path());
  const std::vector<std::string> expected = baked_files("m", options);
  CHECK(names_in(folder.path()) == std::set<std::string>(expected.begin(), expected.end()));
  const nlohmann::json sidecar = read_sidecar(folder.path());
  for (const nlohmann::json& file : sidecar["files"]) {
    const ReadTexture texture = read_by_oiio(folder / file["file"].get<std::string>());
    CHECK(texture.width == 48);
    CHECK(static_cast<std::size_t>(texture.channels) == file["channels"].size());
    CHECK_FALSE(file["definition"].get<std::string>().empty());
  }
  const ReadTexture packed = read_by_oiio(folder / "m_packed.png");
  CHECK(packed.at(5, 7, 1) == 32768);
  CHECK(packed.at(5, 7, 2) == read_by_oiio(folder / "m_normal.png").at(5, 7, 1));
}

TEST_CASE("stb and OpenImageIO read the same levels", "[bake][slow]") {
  const ScratchFolder folder;
  const auto [width, height] =
      GENERATE(std::pair{37, 23}, std::pair{1, 1}, std::pair{1, 19}, std::pair{21, 1}, std::pair{64, 32});
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  BakeOptions options;
  options.maps = all_maps();
  options.depth = GENERATE(TextureDepth::uint8, TextureDepth::uint16);
  options.bent_length = true;
  bake_map(make_rough_map(width, height, boundary, 0.2, 0.05, 3), options, folder.path());
  for (const std::string& file : baked_files("m", options)) {
    if (!file.ends_with(".png")) continue;
    INFO(file << ", " << width << " x " << height << ", " << to_string(boundary));
    const ReadTexture ours = read_by_oiio(folder / file);
    CHECK(ours == read_by_stb(folder / file));
    CHECK(ours.width == width);
    CHECK(ours.height == height);
  }
}

TEST_CASE("levels are the float files' values, rounded", "[bake][slow]") {
  const ScratchFolder folder;
  const Heightmap map = make_synth_map("cobbles", 40, Boundary::tile, 0.2);
  BakeOptions options;
  options.maps = {MaterialMap::ao, MaterialMap::bent_normal, MaterialMap::multibounce, MaterialMap::sh};
  options.albedo.constant = {0.8, 0.4, 0.1};
  options.format = TextureFormat::tif;
  bake_map(map, options, folder / "levels");
  options.format = GENERATE(TextureFormat::exr, TextureFormat::tif);
  options.depth = GENERATE(TextureDepth::real, TextureDepth::half);
  bake_map(map, options, folder / "floats");
  const nlohmann::json sidecar = read_sidecar(folder / "levels");
  for (const nlohmann::json& file : sidecar["files"]) {
    const std::string name = file["file"];
    const ReadTexture levels = read_by_oiio(folder / "levels" / name);
    const std::string other =
        name.substr(0, name.find('.')) + (options.format == TextureFormat::exr ? ".exr" : ".tif");
    const ReadTexture floats = read_by_oiio(folder / "floats" / other);
    REQUIRE(levels.samples.size() == floats.samples.size());
    double worst = 0;
    for (std::size_t i = 0; i < levels.samples.size(); ++i) {
      const nlohmann::json& channel = file["channels"][i % static_cast<std::size_t>(levels.channels)];
      const double low = channel["value_of_level_0"];
      const double high = channel["value_of_level_65535"];
      const double value = low + (high - low) * static_cast<double>(levels.samples[i]) / 65535;
      worst = std::max(worst, std::fabs(value - static_cast<double>(floats.samples[i])) / (high - low));
    }
    INFO(name);
    // half a level (and the hair by which halves go up); half floats round to 2^-11 of the value
    CHECK(worst <= (0.5 + 0.005) / 65535 + (options.depth == TextureDepth::half ? std::ldexp(1, -11) : 1e-7));
  }
}

TEST_CASE("a flat map is white, and its normals are (128, 128, 255)", "[bake]") {
  const ScratchFolder folder;
  BakeOptions options;
  options.maps = all_maps();
  options.depth = TextureDepth::uint8;
  options.dither = GENERATE(false, true);
  options.y_down = GENERATE(false, true);
  bake_map(make_map(20, 10, Boundary::tile, [](int, int) { return 0.25; }), options, folder.path());
  for (const char* name : {"m_normal.png", "m_bent-normal.png"}) {
    const ReadTexture normals = read_by_stb(folder / name);
    for (std::size_t i = 0; i < normals.samples.size(); ++i) {
      REQUIRE(normals.samples[i] == (i % 3 == 2 ? 255 : 128));
    }
  }
  for (const char* name : {"m_ao.png", "m_multibounce.png", "m_bent-cone-spread.png"}) {
    for (const float level : read_by_stb(folder / name).samples) REQUIRE(level == 255);
  }
}

TEST_CASE("DirectX's normals are OpenGL's with y upside down", "[bake]") {
  const ScratchFolder folder;
  const Heightmap map = make_synth_map("fbm", 32, Boundary::tile, 0.2);
  BakeOptions options;
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  options.maps = {MaterialMap::normal, MaterialMap::bent_normal, MaterialMap::horizon, MaterialMap::sh};
  bake_map(map, options, folder / "gl");
  options.y_down = true;
  bake_map(map, options, folder / "dx");
  for (const char* name : {"m_normal.exr", "m_bent-normal.exr"}) {
    const ReadTexture gl = read_by_oiio(folder / "gl" / name);
    ReadTexture dx = read_by_oiio(folder / "dx" / name);
    for (std::size_t i = 1; i < dx.samples.size(); i += 3) dx.samples[i] = -dx.samples[i];
    CHECK(gl == dx);
  }
  const ReadTexture gl = read_by_oiio(folder / "gl" / "m_horizon.exr");
  const ReadTexture dx = read_by_oiio(folder / "dx" / "m_horizon.exr");
  for (int column = 0; column < 32; ++column) {
    CHECK(gl.at(3, column, 0) == dx.at(3, column, 0));
    CHECK(gl.at(3, column, 1) == dx.at(3, column, 3));  // up the picture
    CHECK(gl.at(3, column, 2) == dx.at(3, column, 2));
  }
}

/// Shifted by whole tiles of receivers.
ReadTexture shift(const ReadTexture& texture, int rows, int columns) {
  ReadTexture shifted = texture;
  for (int row = 0; row < texture.height; ++row) {
    for (int column = 0; column < texture.width; ++column) {
      for (int c = 0; c < texture.channels; ++c) {
        const int to = (row + rows) % texture.height * texture.width + (column + columns) % texture.width;
        shifted.samples[static_cast<std::size_t>(to * texture.channels + c)] = texture.at(row, column, c);
      }
    }
  }
  return shifted;
}

TEST_CASE("tiles stay tiles to the last bit, dithered too", "[bake][slow]") {
  const ScratchFolder folder;
  const auto [rows, columns] = GENERATE(std::pair{64, 0}, std::pair{64, 128});
  const Heightmap map = make_synth_map("brick", 192, Boundary::tile, 0.1);
  BakeOptions options;
  options.maps = {MaterialMap::ao, MaterialMap::bent_normal, MaterialMap::sh, MaterialMap::horizon};
  options.maximum_distance =
      GENERATE(std::optional<MaximumDistance>{}, std::optional<MaximumDistance>{{0.1, Falloff::linear}});
  options.depth = TextureDepth::uint8;
  options.dither = true;
  options.azimuths = 16;
  options.error = 0.05;  // so that the coarsest walk serves, whichever receivers try it
  bake_map(map, options, folder / "here");
  bake_map(shift_map(map, rows, columns), options, folder / "there");
  for (const std::string& file : baked_files("m", options)) {
    if (!file.ends_with(".png")) continue;
    INFO(file);
    CHECK(read_by_stb(folder / "there" / file) == shift(read_by_stb(folder / "here" / file), rows, columns));
  }
}

TEST_CASE("a coloured albedo's channels are three grey runs, bit for bit, and pits grow more saturated",
          "[bake][slow]") {
  const ScratchFolder folder;
  const Heightmap map = make_synth_map("brick", 96, Boundary::tile, 0.15);
  BakeOptions options;
  options.maps = {MaterialMap::ao, MaterialMap::multibounce};
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  const std::vector<double> red{0.7, 0.25, 0.15};
  options.albedo.constant = red;
  bake_map(map, options, folder / "colour");
  const ReadTexture colour = read_by_oiio(folder / "colour" / "m_multibounce.exr");
  for (int c = 0; c < 3; ++c) {
    options.albedo.constant = {red[static_cast<std::size_t>(c)]};
    bake_map(map, options, folder / "grey");
    const ReadTexture grey = read_by_oiio(folder / "grey" / "m_multibounce.exr");
    for (std::size_t i = 0; i < grey.samples.size(); ++i) {
      REQUIRE(grey.samples[i] == colour.samples[3 * i + static_cast<std::size_t>(c)]);
    }
  }
  const ReadTexture ao = read_by_oiio(folder / "colour" / "m_ao.exr");
  double open = 0;
  double pits = 0;
  int open_count = 0;
  int pit_count = 0;
  for (std::size_t i = 0; i < ao.samples.size(); ++i) {
    // Reflected light is albedo × E: its red over its green, against the albedo's own.
    const double saturation =
        static_cast<double>(colour.samples[3 * i]) / static_cast<double>(colour.samples[3 * i + 1]);
    if (ao.samples[i] > 0.95F) {
      open += saturation;
      ++open_count;
    } else if (ao.samples[i] < 0.5F) {
      pits += saturation;
      ++pit_count;
    }
  }
  REQUIRE(open_count > 0);
  REQUIRE(pit_count > 0);
  INFO("red over green, beyond the albedo's: open " << open / open_count << ", pits " << pits / pit_count);
  CHECK(open / open_count < 1.05);
  CHECK(pits / pit_count > 1.15);
}

TEST_CASE("an albedo map per channel is three maps of grey, bit for bit", "[bake]") {
  const ScratchFolder folder;
  const Heightmap map = make_synth_map("fbm", 64, Boundary::tile, 0.2);
  BakeOptions options;
  options.maps = {MaterialMap::multibounce};
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  options.albedo.constant.clear();
  for (int c = 0; c < 3; ++c) {
    TexelVector albedo(std::size_t{64} * 64);
    for (std::size_t i = 0; i < albedo.size(); ++i)
      albedo[i] = 0.2 + 0.6 * unit_real(hash_combine(
                                  5, 3 * (i / 64 / 8 * 8 + i % 64 / 8) + static_cast<std::uint64_t>(c)));
    options.albedo.varying.push_back(albedo);
  }
  bake_map(map, options, folder / "colour");
  const ReadTexture colour = read_by_oiio(folder / "colour" / "m_multibounce.exr");
  const std::vector<TexelVector> channels = options.albedo.varying;
  for (std::size_t c = 0; c < 3; ++c) {
    options.albedo.varying = {channels[c]};
    bake_map(map, options, folder / "grey");
    const ReadTexture grey = read_by_oiio(folder / "grey" / "m_multibounce.exr");
    for (std::size_t i = 0; i < grey.samples.size(); ++i)
      REQUIRE(grey.samples[i] == colour.samples[3 * i + c]);
  }
}

TEST_CASE("files are the same for any number of threads and from run to run", "[bake]") {
  const ScratchFolder folder;
  BakeOptions options;
  options.maps = all_maps();
  options.maximum_distance =
      GENERATE(std::optional<MaximumDistance>{}, std::optional<MaximumDistance>{{0.1, Falloff::linear}});
  for (const int threads : {1, 2, 7}) {
    const ThreadScope scope(threads);
    bake_map(make_synth_map("brick", 80, Boundary::tile, 0.1), options, folder / std::to_string(threads));
  }
  for (const std::string& file : baked_files("m", options)) {
    if (file.ends_with(".json")) continue;
    INFO(file);
    CHECK((read_text(folder / "1" / file) == read_text(folder / "2" / file)));
    CHECK((read_text(folder / "1" / file) == read_text(folder / "7" / file)));
  }
}

TEST_CASE("with a reach, ao opens, and bounces stay as they are", "[bake][slow]") {
  const ScratchFolder folder;
  const Heightmap map = make_synth_map("brick", 64, Boundary::tile, 0.15);
  BakeOptions options;
  options.maps = {MaterialMap::ao, MaterialMap::multibounce};
  options.azimuths = 16;
  bake_map(map, options, folder / "far");
  options.maximum_distance = MaximumDistance{0.05, Falloff::linear};
  bake_map(map, options, folder / "near");
  const ReadTexture far = read_by_oiio(folder / "far" / "m_ao.png");
  const ReadTexture near = read_by_oiio(folder / "near" / "m_ao.png");
  double opened = 0;
  for (std::size_t i = 0; i < far.samples.size(); ++i)
    opened += static_cast<double>(near.samples[i] - far.samples[i]);
  CHECK(opened / static_cast<double>(far.samples.size()) > 0.01 * 65535);
  const nlohmann::json sidecar = read_sidecar(folder / "near");
  CHECK(sidecar["reach"]["max_distance"] == 0.05);
  CHECK(sidecar["errors"]["ao_rmse"].get<double>() < 0.004);
}

TEST_CASE("missing samples are open in files of integers and NaN in files of floats", "[bake]") {
  const ScratchFolder folder;
  Heightmap map = make_synth_map("fbm", 24, Boundary::open, 0.2);
  map.height(3, 4) = std::nanf("");
  BakeOptions options;
  options.maps = all_maps();
  bake_map(map, options, folder / "levels");
  CHECK(read_by_oiio(folder / "levels" / "m_ao.png").at(3, 4, 0) == 65535);
  CHECK(read_by_oiio(folder / "levels" / "m_bent-normal.png").at(3, 4, 0) == 32768);
  CHECK(read_by_oiio(folder / "levels" / "m_multibounce.png").at(3, 4, 0) == 65535);
  options.format = TextureFormat::exr;
  options.depth = TextureDepth::real;
  bake_map(map, options, folder / "floats");
  for (const std::string& file : baked_files("m", options)) {
    if (!file.ends_with(".exr")) continue;
    INFO(file);
    const ReadTexture texture = read_by_oiio(folder / "floats" / file);
    for (int c = 0; c < texture.channels; ++c) CHECK(std::isnan(texture.at(3, 4, c)));
    CHECK_FALSE(std::isnan(texture.at(3, 5, 0)));
  }
}

TEST_CASE("what is to be known of a file stands in its sidecar", "[bake]") {
  const ScratchFolder folder;
  LoadedHeightmap loaded;
  loaded.map = make_synth_map("fbm", 32, Boundary::tile, 0.1);
  loaded.warnings = {{"some of it is odd", "no_data -1"}};
  BakeOptions options;
  options.maps = {MaterialMap::height};
  const std::vector<Warning> warnings =
      bake_material(loaded, options, {.source = "m.png", .inputs = {}, .folder = folder.path(), .name = "m"})
          .warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].message == "some of it is odd");
  CHECK(read_sidecar(folder.path())["warnings"] == nlohmann::json::array({"some of it is odd (no_data -1)"}));
}

TEST_CASE("options that contradict each other are refused before any work, and too little memory is named",
          "[bake]") {
  BakeOptions good;
  good.maps = {MaterialMap::ao};
  CHECK_NOTHROW(check_bake_options(good));
  std::vector<BakeOptions> bad(9, good);
  bad[0].maps.clear();
  bad[1].maps = {MaterialMap::ao, MaterialMap::ao};
  bad[2].depth = TextureDepth::half;
  bad[3].format = TextureFormat::exr;
  bad[4].dither = true;
  bad[5].maximum_distance = MaximumDistance{0, Falloff::none};
  bad[6].error = 0;
  bad[7].horizon_azimuths = 0;
  bad[8].packed = {{"packed", {{MaterialMap::ao, 1, 0}}}};
  for (const BakeOptions& options : bad) CHECK_THROWS_AS(check_bake_options(options), UsageError);
  const ScratchFolder folder;
  good.memory = 1000;
  const auto bake = [&] { bake_map(make_synth_map("fbm", 32, Boundary::tile, 0.1), good, folder.path()); };
  CHECK_THROWS_AS(bake(), MemoryError);
  CHECK_THROWS_WITH(bake(), Catch::Contains("32 × 32") && Catch::Contains("of memory allowed"));
  CHECK_THAT(remedy_of(bake), Catch::StartsWith("memory ") && Catch::EndsWith("M"));
  CHECK(folder.entry_count() == 0);
}

}  // namespace
}  // namespace heightlight
