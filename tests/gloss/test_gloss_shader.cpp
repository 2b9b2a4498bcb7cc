#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "heightlight/closed_forms.h"
#include "heightlight/gloss.h"
#include "heightlight/occlusion_forms.h"
#include "heightlight/shaders.h"
#include "scratch_folder.h"

// The shader text of specular occlusion, compiled as C++, says what the C++ forms say.

namespace heightlight {
namespace {

/// What a shader compiler knows and C++ does not, as far as the text uses it.
constexpr const char* kGlossShim = R"(
#include <cmath>
#include <cstdio>
namespace shader {
struct vec3 { float x, y, z; vec3(float a, float b, float c) : x(a), y(b), z(c) {} vec3() : x(0), y(0), z(0) {} };
struct vec4 { float x, y, z, w; vec4(float a, float b, float c, float d) : x(a), y(b), z(c), w(d) {} };
using float3 = vec3;
using float4 = vec4;
vec3 operator+(vec3 a, vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
vec3 operator-(vec3 a, vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
vec3 operator*(float s, vec3 a) { return vec3(s * a.x, s * a.y, s * a.z); }
vec3 operator/(vec3 a, float s) { return vec3(a.x / s, a.y / s, a.z / s); }
float min(float a, float b) { return a < b ? a : b; }
int min(int a, int b) { return a < b ? a : b; }
float max(float a, float b) { return a > b ? a : b; }
float pow(float a, float b) { return std::pow(a, b); }
float sqrt(float a) { return std::sqrt(a); }
float exp2(float a) { return std::exp2(a); }
float floor(float a) { return std::floor(a); }
float sin(float a) { return std::sin(a); }
float cos(float a) { return std::cos(a); }
float acos(float a) { return std::acos(a); }
float atan(float a, float b) { return std::atan2(a, b); }
float atan2(float a, float b) { return std::atan2(a, b); }
float dot(vec3 a, vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
vec3 cross(vec3 a, vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
vec3 normalize(vec3 a) { return a / sqrt(dot(a, a)); }
#include "gloss.shader"
}
int main() {
  using namespace shader;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 1; j <= 10; ++j) {
      float sky = i / 20.0f, roughness = j / 10.0f, apart = (7 * i % 21) / 14.0f, cosine = (3 * i % 19 + 1) / 20.0f;
      vec3 normal = normalize(vec3(0.3f, -0.1f * j, 1.5f)), view = normalize(vec3(0.1f * i - 1, 0.4f, 1.2f));
      vec3 light[9];
      float slope[8];
      for (int k = 0; k < 9; ++k) light[k] = vec3(0.3f * k, 1 - 0.1f * k, 0.2f);
      for (int k = 0; k < 8; ++k) slope[k] = 0.5f + 0.1f * ((3 * k + i) % 8);
      vec3 e = heightlight_directional_irradiance(light, sky, normal);
      vec4 p = heightlight_table_place(sky, apart, roughness, cosine);
      std::printf("%.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g\n", e.x, e.y,
                  heightlight_cone_cone(sky, apart, roughness), heightlight_lagarde(sky, cosine, roughness), p.x,
                  p.y, p.z, p.w, heightlight_table_weight(cosine),
                  heightlight_horizon_occlusion(normal, view, roughness, slope));
    }
  }
}
)";

std::string run_gloss_shader(const std::string& text) {
  const ScratchFolder scratch;
  write_text(scratch / "gloss.shader", text);
  write_text(scratch / "main.cpp", kGlossShim);
  const std::string command = "cd '" + scratch.path().string() +
                              "' && " HEIGHTLIGHT_COMPILER
                              " -w -O0 main.cpp -o program > log 2>&1 && ./program > out 2>> log";
  const int status = std::system(command.c_str());
  INFO(read_text(scratch / "log"));
  REQUIRE(status == 0);
  return read_text(scratch / "out");
}

Direction<double> unit_of(double x, double y, double z) {
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

/// The table at texture coordinates, filtered as textures are.
double filter(const SpecularTable& table, double x, double y, double z) {
  const auto side = static_cast<std::size_t>(table.side);
  const double places[] = {x * table.side - 0.5, y * table.side - 0.5, z * table.side * table.side - 0.5};
  double sum = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t at[3];
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double below = std::floor(places[axis]);
      const bool is_upper = (corner >> axis & 1U) != 0;
      const double largest = (axis == 2 ? table.side : 1) * table.side - 1;
      weight *= is_upper ? places[axis] - below : 1 - (places[axis] - below);
      at[axis] = static_cast<std::size_t>(std::clamp(below + (is_upper ? 1 : 0), 0.0, largest));
    }
    sum += weight * table.values[(at[2] * side + at[1]) * side + at[0]];
  }
  return sum / 255;
}

}  // namespace

TEST_CASE("shaders of specular occlusion say what the forms say", "[gloss]") {
  const SpecularTable table = make_specular_table(kShaderTableSide);
  for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl}) {
    std::istringstream out(run_gloss_shader(gloss_shader(language, 8)));
    for (int i = 0; i <= 20; ++i) {
      for (int j = 1; j <= 10; ++j) {
        const double sky = i / 20.0;
        const double roughness = j / 10.0;
        const double apart = (7 * i % 21) / 14.0;
        const double cosine = (3 * i % 19 + 1) / 20.0;
        const Direction<double> normal = unit_of(0.3, -0.1 * j, 1.5);
        const Direction<double> view = unit_of(0.1 * i - 1, 0.4, 1.2);
        NineHarmonics<double> red{};
        NineHarmonics<double> green{};
        std::vector<double> slopes;
        for (int k = 0; k < 9; ++k) {
          red.at(static_cast<std::size_t>(k)) = 0.3 * k;
          green.at(static_cast<std::size_t>(k)) = 1 - 0.1 * k;
        }
        for (int k = 0; k < 8; ++k) slopes.push_back(0.5 + 0.1 * ((3 * k + i) % 8));
        double values[10];
        for (double& value : values) out >> value;
        REQUIRE(out);
        INFO(i << " " << j);
        const SkyViewFactor<double> open{sky};
        // Single precision, whose cancellation is worst where cones touch; a direction of the horizons that
        // grazes one may fall on its other side.
        CHECK(values[0] == Approx(directional_irradiance(red, open, normal)).margin(1e-5));
        CHECK(values[1] == Approx(directional_irradiance(green, open, normal)).margin(1e-5));
        CHECK(values[2] == Approx(cone_cone_occlusion(open, apart, roughness)).margin(2e-3));
        CHECK(values[3] == Approx(lagarde_occlusion(open, cosine, roughness)).margin(1e-5));
        const double found = (1 - values[8]) * filter(table, values[4], values[5], values[6]) +
                             values[8] * filter(table, values[4], values[5], values[7]);
        const double expected = look_up(table, {.half_angle = angle_of_cosine(cone_cosine(open)),
                                                .apart = apart,
                                                .roughness = roughness,
                                                .view_angle = std::acos(cosine)});
        CHECK(found == Approx(expected).margin(2e-4));
        CHECK(values[9] == Approx(horizon_occlusion(normal, view, roughness,
                                                    StoredHorizons<double>(slopes.data(), slopes.size())))
                               .margin(0.08));
      }
    }
  }
}

}  // namespace heightlight
