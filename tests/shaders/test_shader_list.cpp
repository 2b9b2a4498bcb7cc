#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

#include "heightlight/shaders.h"
#include "scratch_folder.h"
#include "shaders/shader_print.h"
#include "shaders/trial_function.h"

namespace heightlight {
namespace {

using Catch::Contains;

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// "RMS of E/pi .0198 at albedo .5, .0464 at .9" by plots/data/models.csv, per texel, by model.
std::map<std::string, std::string> measured_errors() {
  std::ifstream file(HEIGHTLIGHT_SOURCE_DIR "/plots/data/models.csv");
  std::map<std::string, std::map<std::string, std::string>> rms;
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> cells = split(line);
    if (cells.size() < 5 || cells[2] != "texel" || (cells[3] != "0.5" && cells[3] != "0.9")) continue;
    std::ostringstream digits;
    digits << std::fixed << std::setprecision(4) << std::stod(cells[4]);
    rms[cells[0]][cells[3]] = digits.str().substr(1);
  }
  std::map<std::string, std::string> errors;
  for (const auto& [model, by_albedo] : rms) {
    errors[model] = "RMS of E/pi " + by_albedo.at("0.5") + " at albedo .5, " + by_albedo.at("0.9") + " at .9";
  }
  return errors;
}

const ShaderFunction& find_function(const std::string& name) {
  for (const ShaderFunction& function : shader_functions()) {
    if (function.name == name) return function;
  }
  throw std::runtime_error("there is no " + name);
}

}  // namespace

TEST_CASE("errors that shaders tell are those of plots/data/models.csv", "[shaders]") {
  const std::map<std::string, std::string> measured = measured_errors();
  REQUIRE(measured.size() > 10);
  const std::map<std::string, std::string> model_of{
      {"heightlight_uniform_neighbourhood", "uniform_neighbourhood"},
      {"heightlight_cubic", "cubic"},
      {"heightlight_notes", "notes_guarded"},
      {"heightlight_bounced", "seen_stored"},
      {"heightlight_seen_from_sky", "seen_from_sky_refit"},
      {"heightlight_seen_from_map", "seen_from_map_refit"},
      {"heightlight_seen_from_deep", "seen_from_deep_refit"},
      {"heightlight_seen_from_blur", "seen_from_blur_refit"}};
  for (const auto& [function, model] : model_of) {
    CHECK_THAT(find_function(function).error, Catch::StartsWith(measured.at(model)));
  }
}

TEST_CASE("a cone's error that shaders tell is that of plots/data/directional_*.csv", "[shaders]") {
  std::map<std::string, std::pair<double, double>> range;  // by sky: least and greatest RMSE
  for (const char* map : {"brick", "ground054", "lakes", "metalwalkway006"}) {
    std::ifstream file(std::string(HEIGHTLIGHT_SOURCE_DIR "/plots/data/directional_") + map + ".csv");
    for (std::string line; std::getline(file, line);) {
      const std::size_t method = line.find(",function,exact,\"directional GTAO, SH9\",");
      if (method == std::string::npos) continue;
      const double rmse = std::stod(split(line.substr(line.rfind('"') + 2)).at(1));
      auto& [least, most] = range.try_emplace(line.substr(0, method), rmse, rmse).first->second;
      least = std::min(least, rmse);
      most = std::max(most, rmse);
    }
  }
  const auto told = [&](const std::string& sky) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(4) << range.at(sky).first << " to " << range.at(sky).second;
    std::string all = text.str();
    for (std::size_t at = all.find("0."); at != std::string::npos; at = all.find("0.", at)) all.erase(at, 1);
    return all;
  };
  const std::string error = find_function("heightlight_cone_bands").error;
  CHECK_THAT(error, Contains(told("overcast") + " under an overcast"));
  CHECK_THAT(error, Contains(told("low-sun") + " under a low sun"));
}

TEST_CASE("errors of gloss that shaders tell are those of plots/data/specular_*.csv", "[shaders]") {
  const std::map<std::string, std::string> method_of{
      {"heightlight_cone_cone", "cone-cone, u 0.01"},
      {"heightlight_lagarde", "Lagarde"},
      {"heightlight_table_place", "GTSO, table of 16^4"},
      {"heightlight_horizon_occlusion", "16 horizons, 16 directions"}};
  for (const auto& [function, method] : method_of) {
    double least = 1;
    double most = 0;
    for (const char* map : {"brick", "ground054", "lakes", "metalwalkway006"}) {
      std::ifstream file(std::string(HEIGHTLIGHT_SOURCE_DIR "/plots/data/specular_") + map + ".csv");
      const std::string row = '"' + method + "\",0.13,45,";
      for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("exact," + row) && !line.starts_with(',' + row))
          continue;  // horizons have no input
        const double rmse = std::stod(line.substr(line.find(row) + row.size()));
        least = std::min(least, rmse);
        most = std::max(most, rmse);
      }
    }
    std::ostringstream told;
    told << std::fixed << std::setprecision(4) << "RMSE " << least << " to " << most;
    CAPTURE(function);
    CHECK_THAT(find_function(function).error, Catch::StartsWith(told.str()));
  }
}

TEST_CASE("each shader function stands behind those that it calls, once, in every language", "[shaders]") {
  for (const ShaderLanguageName& language : kShaderLanguages) {
    const std::string text = shader_library(language.language);
    CHECK_THAT(text, Catch::StartsWith(shader_library_mark()));
    CHECK(text.find_first_of("$@?") == std::string::npos);
    for (const char byte : text) REQUIRE((byte == '\n' || (byte >= ' ' && byte <= '~')));
    std::set<std::string> known;
    for (const ShaderFunction& function : shader_functions()) {
      CAPTURE(language.name, function.name);
      for (const ShaderFunction& other : shader_functions()) {
        if (function.text.find(other.name + '(') != std::string::npos && other.name != function.name)
          CHECK(known.count(other.name) == 1);
      }
      CHECK(known.insert(function.name).second);
      CHECK(text.find(' ' + function.name + '(') != std::string::npos);
      CHECK_FALSE(function.formula.empty());
      CHECK_FALSE(function.twin.empty());
    }
  }
}

TEST_CASE("shaders are written as each language has them", "[shaders]") {
  const std::vector<ShaderFunction> one{
      {.name = "f",
       .formula = "a trial",
       .source = "",
       .error = "",
       .inputs = {{"x", "a number"}, {.name = "albedo", .meaning = "an albedo", .is_clamped = false}},
       .is_per_channel = true,
       .text = "float f(float x, float albedo) {\n  vec2 pair = vec2(x, fract(albedo));\n"
               "  if (x <= 0.0) { return 1.0; }\n  return mix(pair.x, pair.y, inversesqrt(x));\n}\n",
       .twin = "none",
       .evaluate = {}}};
  const std::string comment =
      "// a trial.\n//   x: a number; 0 to 1, clamped\n//   albedo: an albedo; 0 to 1\n";
  const std::string same = "\n// The same for albedos of three channels.\n";
  CHECK(print_shader(one, ShaderLanguage::glsl) ==
        comment + one[0].text + same +
            "vec3 f(float x, vec3 albedo) {\n  return vec3(f(x, albedo.x),\n    f(x, albedo.y),\n    f(x, "
            "albedo.z));\n}\n");
  CHECK(print_shader(one, ShaderLanguage::hlsl) ==
        comment +
            "float f(float x, float albedo) {\n  float2 pair = float2(x, frac(albedo));\n"
            "  if (x <= 0.0) { return 1.0; }\n  return lerp(pair.x, pair.y, rsqrt(x));\n}\n" +
            same +
            "float3 f(float x, float3 albedo) {\n  return float3(f(x, albedo.x),\n    f(x, albedo.y),\n    "
            "f(x, "
            "albedo.z));\n}\n");
  CHECK(print_shader(one, ShaderLanguage::wgsl) ==
        comment +
            "fn f(x: f32, albedo: f32) -> f32 {\n  let pair: vec2<f32> = vec2<f32>(x, fract(albedo));\n"
            "  if (x <= 0.0) { return 1.0; }\n  return mix(pair.x, pair.y, inverseSqrt(x));\n}\n" +
            same +
            "fn f_rgb(x: f32, albedo: vec3<f32>) -> vec3<f32> {\n  return vec3<f32>(f(x, albedo.x),\n"
            "    f(x, albedo.y),\n    f(x, albedo.z));\n}\n");
}

TEST_CASE("loops, arrays and variables of shaders are written as each language has them", "[shaders]") {
  const std::string text = trial_function().text;
  const std::string with_atan = std::string(text).replace(text.find("atan2"), 5, "atan");
  CHECK(print_source(text, ShaderLanguage::glsl) == with_atan);
  CHECK(print_source(text, ShaderLanguage::godot) == with_atan);
  CHECK(print_source(text, ShaderLanguage::hlsl) ==
        std::string(text).replace(text.find("vec3"), 4, "float3"));
  CHECK(print_source(text, ShaderLanguage::wgsl) ==
        "fn turn(slope: array<f32, 8>, d: vec3<f32>) -> f32 {\n  var sum: f32 = 0.0;\n  let part: f32 = "
        "0.125;\n"
        "  var last: i32 = 7;\n  if (d.z > 0.0) { last = 6; }\n  for (var i: i32 = 0; i < 8; i++) {\n"
        "    if (i > last) { continue; }\n    sum += part * slope[i];\n  }\n"
        "  return sum + 0.1 * atan2(d.y, d.x) * f32(last);\n}\n");
}

TEST_CASE("the shader beside ao-n maps gives 1 where bounced_total does, at n = 0 and albedo 1",
          "[shaders]") {
  const ScratchFolder scratch;
  write_text(scratch / "ao-n.glsl", stored_pair_shader(ShaderLanguage::glsl));
  write_text(scratch / "main.cpp", R"(#include <cstdio>
struct vec2 { float x, y; };
struct vec3 { float x, y, z; vec3(float a, float b, float c) : x(a), y(b), z(c) {} };
float min(float a, float b) { return a < b ? a : b; }
float max(float a, float b) { return a > b ? a : b; }
#include "ao-n.glsl"
int main() {
  vec3 found = multi_bounce(vec2{0.25f, 0.0f}, vec3(0.0f, 0.5f, 1.0f));
  std::printf("%.9g %.9g %.9g ", found.x, found.y, found.z);
  found = multi_bounce(vec2{0.0f, 1e-5f}, vec3(1.0f, 1.0f, 1.0f));
  std::printf("%.9g\n", found.x);
}
)");
  const std::string command = "cd '" + scratch.path().string() +
                              "' && " HEIGHTLIGHT_COMPILER
                              " -w -O0 main.cpp -o program > log 2>&1 && ./program > out 2>> log";
  const int status = std::system(command.c_str());
  INFO(read_text(scratch / "log"));
  REQUIRE(status == 0);
  CHECK(read_text(scratch / "out") == "0.25 0.25 1 1\n");
  for (const double albedo : {0.0, 0.5, 1.0}) {
    CHECK(bounced_total(SkyViewFactor(0.25), SeenSkyViewFactor(0.0), albedo) == (albedo < 1 ? 0.25 : 1));
  }
}

}  // namespace heightlight
