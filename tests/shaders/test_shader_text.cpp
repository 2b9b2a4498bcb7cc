#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "heightlight/closed_forms.h"
#include "heightlight/shaders.h"
#include "scratch_folder.h"

namespace heightlight {
namespace {

/// What a shader compiler knows and C++ does not, as far as the text uses it.
constexpr const char* kShim = R"(
#include <cmath>
#include <cstdio>
namespace shader {
struct vec3 { float x, y, z; vec3(float a, float b, float c) : x(a), y(b), z(c) {} };
using float3 = vec3;
float min(float a, float b) { return a < b ? a : b; }
float max(float a, float b) { return a > b ? a : b; }
float pow(float a, float b) { return std::pow(a, b); }
float sqrt(float a) { return std::sqrt(a); }
float exp(float a) { return std::exp(a); }
#include "models.shader"
}
int main() {
  using namespace shader;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 10; ++j) {
      float ao = i / 40.0f, other = (7 * i % 41) / 40.0f, albedo = j / 10.0f;
      vec3 albedos(albedo, 1 - albedo, 0.3f);
      std::printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g",
                  heightlight_uniform_neighbourhood(ao, albedo), heightlight_cubic(ao, albedo),
                  heightlight_cubic_fitted(ao, albedo), heightlight_notes(ao, albedo),
                  heightlight_notes_fitted(ao, albedo), heightlight_bounced(ao, other, albedo),
                  heightlight_seen_from_sky(ao), heightlight_seen_from_map(ao, other),
                  heightlight_seen_from_deep(ao, other), heightlight_seen_from_blur(ao, other));
      vec3 three = heightlight_bounced(ao, other, albedos);
      std::printf(" %.9g %.9g %.9g", three.x, three.y, three.z);
      three = heightlight_notes(ao, albedos);
      std::printf(" %.9g %.9g %.9g\n", three.x, three.y, three.z);
    }
  }
}
)";

/// Compiles the text as C++ and runs it; what it printed.
std::string run_as_cpp(const std::string& text) {
  const ScratchFolder scratch;
  write_text(scratch / "models.shader", text);
  write_text(scratch / "main.cpp", kShim);
  const std::string folder = scratch.path().string();
  const std::string command = "cd '" + folder +
                              "' && " HEIGHTLIGHT_COMPILER
                              " -w -O0 main.cpp -o program > log 2>&1 && ./program > out 2>> log";
  const int status = std::system(command.c_str());
  INFO(read_text(scratch / "log"));
  REQUIRE(status == 0);
  return read_text(scratch / "out");
}

}  // namespace

TEST_CASE("shaders compute what the library does", "[forms]") {
  ShaderConstants constants;
  constants.notes = {0.41, 1, 20.5, 3.1};
  constants.cubic = {1.9, -0.31, 4.5, -0.6, 2.6, 0.71};
  constants.seen.offset = 0.0625;
  constants.seen.map_offset = -0.011;
  constants.seen.map_curvature = -0.2;
  constants.seen.blur_offset = 0.013;
  const auto language = GENERATE(ShaderLanguage::glsl, ShaderLanguage::hlsl);
  const std::string text = shader_text(language, constants);
  CHECK(text.find('$') == std::string::npos);
  CHECK((text.find("vec3") != std::string::npos) == (language == ShaderLanguage::glsl));
  CHECK((text.find("float3") != std::string::npos) == (language == ShaderLanguage::hlsl));
  std::istringstream lines(run_as_cpp(text));
  int compared = 0;
  for (int i = 0; i <= 40; ++i) {
    for (int j = 0; j <= 10; ++j) {
      const auto ao = static_cast<double>(static_cast<float>(i) / 40.0F);
      const auto other = static_cast<double>(static_cast<float>(7 * i % 41) / 40.0F);
      const auto albedo = static_cast<double>(static_cast<float>(j) / 10.0F);
      const SkyViewFactor sky(ao);
      const SeenSkyViewFactor seen(other);
      const AmbientOcclusion alpha(ao);
      const double second = 1 - albedo;
      const double third = static_cast<double>(0.3F);
      for (const double expected :
           {uniform_neighbourhood(sky, albedo), cubic_total(sky, albedo),
            cubic_total(sky, albedo, constants.cubic), notes_total_guarded(alpha, albedo),
            notes_total_guarded(alpha, albedo, constants.notes), bounced_total(sky, seen, albedo),
            guess_seen(sky, constants.seen).value, guess_seen_on_map(sky, seen, constants.seen).value,
            guess_seen_in_deep(sky, seen, constants.seen).value,
            guess_seen_by_blur(sky, seen, constants.seen).value, bounced_total(sky, seen, albedo),
            bounced_total(sky, seen, second), bounced_total(sky, seen, third),
            notes_total_guarded(alpha, albedo), notes_total_guarded(alpha, second),
            notes_total_guarded(alpha, third)}) {
        double value = -1;
        REQUIRE(lines >> value);
        INFO("AO " << ao << " other " << other << " albedo " << albedo << " column " << compared % 16);
        CHECK(value == Approx(expected).margin(4e-6));  // discretisation of floats, as of forms.h
        ++compared;
      }
    }
  }
  CHECK(compared == 41 * 11 * 16);
}

}  // namespace heightlight
