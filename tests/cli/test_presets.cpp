// Presets hold what engines' documentation says (docs/packing.md), channel by channel.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "folder_contents.h"
#include "packing_bench.h"
#include "shared_data.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kValidator = HEIGHTLIGHT_SOURCE_DIR "/build/npm/node_modules/gltf-validator";
constexpr const char* kMaterials[] = {"DiamondPlate008C", "Ground054", "Leather031"};

/// Corners of three real heightmaps, under the names that they have, and a roughness and a metalness each.
bool write_materials(const PackingBench& bench) {
  for (const char* material : kMaterials) {
    const std::string name = std::string(material) + "_height16.png";
    const auto path = find_shared_data("material/" + name);
    if (!path) return false;
    const Picture whole = read_picture(*path);
    std::vector<std::uint16_t> corner;
    for (int row = 0; row < kBenchSide; ++row) {
      for (int column = 0; column < kBenchSide; ++column)
        corner.push_back(static_cast<std::uint16_t>(
            65535 * whole.values[static_cast<std::size_t>(row * whole.width + column)]));
    }
    write_samples(bench.folder / name, kBenchSide, kBenchSide, {"Y"}, corner);
    fs::copy_file(bench.folder / "brick_rough.png", bench.folder / (std::string(material) + "_rough.png"));
    fs::copy_file(bench.folder / "brick_metal.png", bench.folder / (std::string(material) + "_metal.png"));
  }
  return true;
}

std::string all_materials() {
  std::string files;
  for (const char* material : kMaterials) files += std::string(material) + "_height16.png ";
  return files;
}

constexpr const char* kInputs =
    " --input roughness={material}_rough.png --input metallic={material}_metal.png";

/// Whether a channel of a normal map of 8 bits is large where heights rise by a step of so many texels.
/// Checked where they differ by much.
bool leans_against_rise(const ChannelLevels& levels, const Picture& heights, std::size_t step) {
  int agree = 0;
  int differ = 0;
  for (std::size_t row = 1; row + 1 < kBenchSide; ++row) {
    for (std::size_t column = 1; column + 1 < kBenchSide; ++column) {
      const std::size_t i = row * kBenchSide + column;
      const float rise = heights.values[i + step] - heights.values[i - step];
      if (std::abs(rise) < 0.002F) continue;
      ((rise > 0) == (levels.values[i] < 128) ? agree : differ) += 1;
    }
  }
  REQUIRE(agree + differ > 100);
  REQUIRE((agree == 0 || differ == 0));
  return differ == 0;
}

/// x leans to the right where heights fall to the right; y, as `is_up` says, where they fall up or down the
/// picture.
void check_normals(const PackingBench& bench, const std::string& file, const std::string& heights,
                   bool is_up) {
  const Picture map = read_picture(bench.folder / heights);
  CHECK(leans_against_rise(bench.levels(file, 0), map, 1));
  CHECK(leans_against_rise(bench.levels(file, 1), map, kBenchSide) == !is_up);
  const ChannelLevels out = bench.levels(file, 2);
  CHECK(*std::min_element(out.values.begin(), out.values.end()) >= 127);
}

void check_orm(const PackingBench& bench, const std::string& file, const ChannelLevels& ao) {
  CHECK(channels_of(bench.folder / "out" / file) == std::vector<std::string>{"R", "G", "B"});
  CHECK(bench.levels(file, 0) == ao);
  CHECK(bench.levels(file, 1) == as_levels(bench.rough));
  CHECK(bench.levels(file, 2) == as_levels(bench.metal));
}

}  // namespace

TEST_CASE("Unreal's set of three materials holds ORM, and normals whose y is down", "[cli][bake][preset]") {
  const PackingBench bench;
  if (!write_materials(bench)) return;
  bench.bake(all_materials() + "--maps ao --depth 8");
  bench.bake(all_materials() + "--preset unreal" + kInputs);
  for (const std::string material : kMaterials) {
    INFO(material);
    check_orm(bench, "T_" + material + "_ORM.png", bench.levels(material + "_height16_ao.png", 0));
    check_normals(bench, "T_" + material + "_N.png", material + "_height16.png", false);
  }
}

TEST_CASE("Godot's set of three materials holds ORM, and normals whose y is up", "[cli][bake][preset]") {
  const PackingBench bench;
  if (!write_materials(bench)) return;
  bench.bake(all_materials() + "--maps ao --depth 8");
  bench.bake(all_materials() + "--preset godot" + kInputs);
  for (const std::string material : kMaterials) {
    INFO(material);
    check_orm(bench, material + "_orm.png", bench.levels(material + "_height16_ao.png", 0));
    check_normals(bench, material + "_normal.png", material + "_height16.png", true);
  }
}

TEST_CASE("Unity's mask map holds metallic, occlusion, detail and smoothness", "[cli][bake][preset]") {
  const PackingBench bench;
  bench.bake("brick_height.png --maps ao --depth 8");
  bench.bake("brick_height.png --preset unity-hdrp --input detail=rgb.png:B" + std::string(kInputs));
  CHECK(bench.levels("brick_MaskMap.png", 0) == as_levels(bench.metal));
  CHECK(bench.levels("brick_MaskMap.png", 1) == bench.levels("brick_height_ao.png", 0));
  CHECK(bench.levels("brick_MaskMap.png", 2) == bench.rgb_channel(2));
  CHECK(bench.levels("brick_MaskMap.png", 3) == inverted(as_levels(bench.rough), 255));
  check_normals(bench, "brick_Normal.png", "brick_height.png", true);
}

TEST_CASE("without files of one's own a preset is of a rough material that is no metal",
          "[cli][bake][preset]") {
  const PackingBench bench;
  bench.bake("brick_height.png --preset gltf");
  CHECK(bench.levels("brick_occlusionRoughnessMetallic.png", 1) ==
        ChannelLevels{std::vector<int>(kBenchTexels, 255)});
  CHECK(bench.levels("brick_occlusionRoughnessMetallic.png", 2) ==
        ChannelLevels{std::vector<int>(kBenchTexels, 0)});
  bench.bake("brick_height.png --preset unity-hdrp");
  CHECK(bench.levels("brick_MaskMap.png", 2) == ChannelLevels{std::vector<int>(kBenchTexels, 255)});
  CHECK(bench.levels("brick_MaskMap.png", 3) == ChannelLevels{std::vector<int>(kBenchTexels, 0)});
}

TEST_CASE("Blender and ambientCG have each map in a file of 16 bits", "[cli][bake][preset]") {
  const PackingBench bench;
  bench.bake("brick_height.png --maps ao,height,normal");
  bench.bake("brick_height.png --preset blender");
  fs::copy_file(bench.folder / "brick_height.png", bench.folder / "Brick001_2K-PNG_Displacement.png");
  bench.bake("Brick001_2K-PNG_Displacement.png --preset ambientcg");
  const std::string library = "Brick001_2K-PNG_";
  for (const std::string& ao : {std::string("brick_ao.png"), library + "AmbientOcclusion.png"})
    CHECK(bench.levels(ao, 0) == bench.levels("brick_height_ao.png", 0));
  for (const std::string& height : {std::string("brick_displacement.png"), library + "Displacement.png"})
    CHECK(bench.levels(height, 0) == bench.levels("brick_height_height.png", 0));
  for (std::size_t c = 0; c < 3; ++c) {
    const ChannelLevels up = bench.levels("brick_height_normal.png", c);
    CHECK(bench.levels("brick_normal.png", c) == up);
    CHECK(bench.levels(library + "NormalGL.png", c) == up);
  }
  bench.bake("brick_height.png --maps normal --normal-y directx");
  for (std::size_t c = 0; c < 3; ++c)
    CHECK(bench.levels(library + "NormalDX.png", c) == bench.levels("brick_height_normal.png", c));
}

TEST_CASE("where a preset has a place for ao-n, n goes there, and A before it", "[cli][bake][preset]") {
  const PackingBench bench;
  bench.bake("brick_height.png --maps ao-n --depth 8");
  const ChannelLevels open = bench.levels("brick_height_ao-n.png", 0);
  const ChannelLevels n = bench.levels("brick_height_ao-n.png", 1);
  for (const std::string set :
       {"gltf brick_occlusionRoughnessMetallic", "unreal T_brick_ORM", "godot brick_orm"}) {
    const std::size_t space = set.find(' ');
    INFO(set);
    bench.bake("brick_height.png --maps ao-n --preset " + set.substr(0, space));
    const std::string file = set.substr(space + 1) + ".png";
    CHECK(bench.levels(file, 0) == open);
    CHECK(bench.levels(file, 3) == n);
    CHECK(fs::exists(bench.folder / "out/ao-n.glsl"));
  }
  bench.bake("brick_height.png --maps ao-n --preset unity-hdrp");
  CHECK(bench.levels("brick_ao-n.png", 1) == n);
}

TEST_CASE("what is said beside a preset goes before it", "[cli][bake][preset]") {
  const PackingBench bench;
  bench.bake("brick_height.png --preset unreal --maps ao --normal-y opengl --name '{map}-{stem}'");
  check_normals(bench, "N-brick_height.png", "brick_height.png", true);
  CHECK(bench.levels("ORM-brick_height.png", 0) == bench.levels("ao-brick_height.png", 0));
  bench.bake("brick_height.png --preset unreal --depth 16");
  CHECK(bench.levels("T_brick_ORM.png", 1) == ChannelLevels{std::vector<int>(kBenchTexels, 65535)});
}

TEST_CASE("a preset of one's own is one like those that come along, and a change of it bakes anew",
          "[cli][bake][preset]") {
  const PackingBench bench;
  const auto write = [&](const std::string& channels) {
    write_text(bench.folder / "own.json",
               R"({"unreal": {"name": "{stem}.{map}", "depth": "8", "files": [{"map": "m", "channels": ")" +
                   channels + R"("}]}})");
  };
  const std::string bake = "bake brick_height.png -o out --azimuths 8 --preset-file own.json --skip-existing";
  write("R=height,G=brick_rough.png");
  CHECK_THAT(run_command(bake + " --preset unreal", bench.folder).out, Catch::Contains("1 baked"));
  CHECK(bench.levels("brick_height.m.png", 1) == as_levels(bench.rough));
  CHECK_THAT(run_command(bake + " --preset unreal", bench.folder).out, Catch::Contains("1 skipped"));
  write("R=height,G=brick_metal.png");
  CHECK_THAT(run_command(bake + " --preset unreal", bench.folder).out, Catch::Contains("1 baked"));
  CHECK(run_command(bake + " --preset godot", bench.folder).exit_code == 0);  // one that comes along
}

TEST_CASE("presets that are none are refused in one line, and nothing is written", "[cli][bake][preset]") {
  const PackingBench bench;
  struct Fault {
    const char* preset;
    const char* told;
  };
  const Fault fault = GENERATE(
      Fault{R"([])", "own.json: /: must be an object"},
      Fault{R"({"a": 1})", "is not known (known: ambientcg"},
      Fault{R"({"x": 1})", "own.json: /x: must be an object"},
      Fault{R"({"x": {"file": []}})", "own.json: /x: there is no key \"file\" here"},
      Fault{R"({"x": {}})", "own.json: /x: must have \"files\""},
      Fault{R"({"x": {"files": []}})", "own.json: /x/files: must be a list that is not empty"},
      Fault{R"({"x": {"files": [{"map": "m"}]}})", "own.json: /x/files/0: must have"},
      Fault{R"({"x": {"files": [{"map": "m", "channels": "R=oa"}]}})",
            "own.json: /x/files/0/channels: pack: 'oa'"},
      Fault{R"({"x": {"depth": "12", "files": [{"map": "m", "channels": "R=ao"}]}})",
            "own.json: /x/depth: \"12\""},
      Fault{R"({"x": {"inputs": {"gloss": 2}, "files": [{"map": "m", "channels": "R=ao"}]}})",
            "own.json: /x/inputs/gloss: must be from 0 to 1"},
      Fault{R"({"x": {"files": [{"map": "m", "channels": "R=ao"}, {"map": "m", "channels": "R=ao"}]}})",
            "two files would be called brick_height_m.png"},
      Fault{R"({"x": {"name": "{nom}", "files": [{"map": "m", "channels": "R=ao"}]}})",
            "no placeholder {nom}"});
  INFO(fault.preset);
  write_text(bench.folder / "own.json", fault.preset);
  const auto before = folder_contents(bench.folder.path());
  const CommandResult run =
      run_command("bake brick_height.png -o out --preset-file own.json --preset x", bench.folder);
  INFO(run.error);
  CHECK(run.exit_code != 0);
  CHECK(std::count(run.error.begin(), run.error.end(), '\n') == 1);
  CHECK_THAT(run.error, Catch::Contains(fault.told));
  CHECK(folder_contents(bench.folder.path()) == before);
}

namespace {

/// A square that wears a set as glTF has it: what its positions, normals, tangents and texture coordinates
/// are, and where.
void write_square(const ScratchFolder& folder, const std::string& material) {
  const std::array<float, 48> numbers{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0,   // positions
                                      0,  0,  1, 0, 0,  1, 0, 0, 1, 0,  0, 1,   // normals
                                      1,  0,  0, 1, 1,  0, 0, 1, 1, 0,  0, 1,   // tangents, three of four
                                      1,  0,  0, 1, 0,  1, 1, 1, 1, 0,  0, 0};  // the last; coordinates
  std::ofstream(folder / "out/square.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  const auto view = [](int offset, int bytes) {
    return nlohmann::json{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes}, {"target", 34962}};
  };
  const auto accessor = [](int k, const char* type) {
    return nlohmann::json{{"bufferView", k}, {"componentType", 5126}, {"count", 4}, {"type", type}};
  };
  nlohmann::json asset = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}}}},
      {"meshes",
       {{{"primitives",
          {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"TANGENT", 2}, {"TEXCOORD_0", 3}}},
            {"mode", 6},
            {"material", 0}}}}}}},
      {"buffers", {{{"uri", "square.bin"}, {"byteLength", sizeof numbers}}}},
      {"bufferViews", {view(0, 48), view(48, 48), view(96, 64), view(160, 32)}},
      {"accessors", {accessor(0, "VEC3"), accessor(1, "VEC3"), accessor(2, "VEC4"), accessor(3, "VEC2")}},
      {"images",
       {{{"uri", material + "_occlusionRoughnessMetallic.png"}}, {{"uri", material + "_normal.png"}}}},
      {"textures", {{{"source", 0}}, {{"source", 1}}}},
      {"materials",
       {{{"occlusionTexture", {{"index", 0}}},
         {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}},
         {"normalTexture", {{"index", 1}}}}}}};
  asset["accessors"][0]["min"] = {-1, -1, 0};
  asset["accessors"][0]["max"] = {1, 1, 0};
  write_text(folder / "out/square.gltf", asset.dump(1));
}

int validate(const ScratchFolder& folder, std::string& said) {
  const int status = std::system(("cd '" + folder.path().string() +
                                  "' && node '" HEIGHTLIGHT_SOURCE_DIR "/tests/cli/validate_gltf.mjs' '" +
                                  kValidator + "' out/square.gltf > said 2>&1 < /dev/null")
                                     .c_str());
  said = read_text(folder / "said");
  return status;
}

}  // namespace

TEST_CASE("glTF's validator takes the set of three materials, with and without ao-n", "[cli][bake][preset]") {
  const PackingBench bench;
  if (!write_materials(bench)) return;
  if (std::system("node --version > /dev/null 2>&1") != 0 || !fs::exists(kValidator)) {
    WARN(
        "SKIPPED: glTF is not validated: no node, or no npm package gltf-validator in build/npm here "
        "(scripts/install-packages --tests)");
    return;
  }
  const std::string maps = GENERATE("", " --maps ao-n");
  CAPTURE(maps);
  bench.bake(all_materials() + "--preset gltf" + kInputs + maps);
  std::string said;
  for (const std::string material : kMaterials) {
    write_square(bench.folder, material);
    const int status = validate(bench.folder, said);
    INFO(said);
    CHECK(status == 0);
    const char* format = maps.empty() ? " 32 x 32 rgb\n" : " 32 x 32 rgba\n";
    CHECK_THAT(said, Catch::Contains(material + "_occlusionRoughnessMetallic.png" + format));
    CHECK(bench.levels(material + "_occlusionRoughnessMetallic.png", 1) == as_levels(bench.rough));
    CHECK(bench.levels(material + "_occlusionRoughnessMetallic.png", 2) == as_levels(bench.metal));
  }
  fs::remove(bench.folder / "out/Leather031_normal.png");
  CHECK(validate(bench.folder, said) != 0);
}

}  // namespace heightlight
