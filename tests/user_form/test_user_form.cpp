#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

#include "heightlight/error.h"
#include "scratch_folder.h"
#include "user_form/user_form.h"

namespace heightlight {
namespace {

using Catch::Contains;

/// What a shader compiler knows and C++ does not, as far as the forms below use it.
constexpr const char* kShim = R"(
#include <cmath>
#include <cstdio>
namespace shader {
struct vec3 { float x, y, z; vec3(float a, float b, float c) : x(a), y(b), z(c) {} };
using float3 = vec3;
float min(float a, float b) { return a < b ? a : b; }
float max(float a, float b) { return a > b ? a : b; }
float clamp(float x, float a, float b) { return min(max(x, a), b); }
float mix(float a, float b, float t) { return a * (1 - t) + b * t; }
float lerp(float a, float b, float t) { return mix(a, b, t); }
float pow(float a, float b) { return std::pow(a, b); }
float sqrt(float a) { return std::sqrt(a); }
float exp(float a) { return std::exp(a); }
float floor(float a) { return std::floor(a); }
#include "models.shader"
}
int main() {
  using namespace shader;
  for (int i = 1; i <= 20; ++i) {
    float a = i / 20.0f, b = (7 * i % 21) / 20.0f, c = (5 * i % 21) / 20.0f, rho = (3 * i % 20) / 20.0f;
    vec3 three = heightlight_third(a, b, c, vec3(rho, 0.5f, 0.25f));
    std::printf("%.9g %.9g %.9g %.9g %.9g\n", heightlight_first(a, rho), heightlight_second(b, rho), three.x, three.y,
                three.z);
  }
}
)";

const UserForm kFirst = parse_user_form("first = A/(1 - rho*(1 - A)^k)");
const UserForm kSecond = parse_user_form("second = mix(alpha, 1, saturate(c1*rho)) - mod(-alpha, 3)/4");
const UserForm kThird = parse_user_form("third = A + rho*(1 - A)*n*exp(-alpha)/(1.5 - rho*(1 - n))");

std::string shaders(ShaderLanguage language) {
  std::vector<ShaderFunction> functions;
  for (const auto& [form, constants] : {std::pair{&kFirst, std::vector<double>{1.25}},
                                        {&kSecond, std::vector<double>{0.75}},
                                        {&kThird, std::vector<double>{}}}) {
    for (ShaderFunction& function : user_form_functions(*form, constants))
      functions.push_back(std::move(function));
  }
  return shader_text(language, {}, functions);
}

std::string fault(const std::string& text) {
  try {
    parse_user_form(text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace

TEST_CASE("a user's form knows what it is a function of", "[forms][user-form]") {
  CHECK(kFirst.name == "first");
  CHECK(kFirst.expression.text == "A/(1 - rho*(1 - A)^k)");
  CHECK(user_form_kind(kFirst) == AoKind::sky_view_factor);
  CHECK(user_form_kind(kSecond) == AoKind::ambient_occlusion);
  CHECK(user_form_extra(kFirst) == ExtraInput::none);
  CHECK(user_form_extra(kThird) == ExtraInput::seen);
  CHECK(wants_both_kinds(kThird));
  CHECK_FALSE(wants_both_kinds(kSecond));
  CHECK(describe(kFirst, std::vector<double>{1.25}) == "A/(1 - rho*(1 - A)^k), k = 1.25");
  const ClosedForm form = to_closed_form(kFirst, {1});
  ModelInputs inputs;
  inputs.sky_view_factor = SkyViewFactor(0.3);
  CHECK(form.evaluate(inputs, 0.8).value() == Approx(uniform_neighbourhood(SkyViewFactor(0.3), 0.8)));
  inputs.sky_view_factor = SkyViewFactor(0.0);
  CHECK_FALSE(form.evaluate(inputs, 1).has_value());  // 0/0
}

TEST_CASE("what is no form of a user's is refused", "[forms][user-form]") {
  CHECK_THAT(fault("A"), Contains("must be NAME = EXPRESSION"));
  CHECK_THAT(fault("= A"), Contains("'' is no name"));
  CHECK_THAT(fault("2b = A"), Contains("'2b' is no name"));
  CHECK_THAT(fault("a b = A"), Contains("is no name"));
  CHECK_THAT(fault("a__b = A"), Contains("is no name"));
  for (const char* taken : {"cubic", "share", "bounced", "notes_direct", "notes_refit", "seen_from_sky",
                            "bounce_3", "mine_refit", "cubic_fitted"}) {
    CHECK_THAT(fault(std::string(taken) + " = A"), Contains("is a name of this program's own"));
  }
  CHECK_THAT(fault("mine = A +"), Contains("'mine = A +'") && Contains("column 11"));
  const ScratchFolder folder;
  const auto read = [&](const std::string& text) {
    write_text(folder / "forms.txt", text);
    return read_user_forms({"mine = A"}, folder / "forms.txt");
  };
  CHECK(read("\xEF\xBB\xBF# a remark\n\n  yours = A*rho\r\nhis=n").size() == 3);
  CHECK_THROWS_WITH(read("yours = A\nhis = A*\n"), Contains("forms.txt: line 2") && Contains("column 9"));
  CHECK_THROWS_WITH(read("mine = A*rho\n"), Contains("given twice"));
  CHECK_THROWS_WITH(read_user_forms({}, folder / "absent.txt"), Contains("absent.txt: no such file"));
}

TEST_CASE("a user's form as a shader computes what it does here", "[forms][user-form]") {
  const auto language = GENERATE(ShaderLanguage::glsl, ShaderLanguage::hlsl);
  const ScratchFolder scratch;
  write_text(scratch / "models.shader", shaders(language));
  write_text(scratch / "main.cpp", kShim);
  const std::string command = "cd '" + scratch.path().string() +
                              "' && " HEIGHTLIGHT_COMPILER
                              " -w -O0 main.cpp -o program > log 2>&1 && "
                              "./program > out 2>> log";
  const int status = std::system(command.c_str());
  INFO(read_text(scratch / "log"));
  REQUIRE(status == 0);
  std::istringstream lines(read_text(scratch / "out"));
  for (int i = 1; i <= 20; ++i) {
    const auto at = [i](int step, int period) {
      return double{static_cast<float>(step * i % period) / 20.0F};
    };
    ModelInputs first;
    first.sky_view_factor = SkyViewFactor(at(1, 21));
    ModelInputs second;
    second.ambient_occlusion = AmbientOcclusion(at(7, 21));
    ModelInputs third = first;
    third.ambient_occlusion = second.ambient_occlusion;
    third.seen = SeenSkyViewFactor(at(5, 21));
    const double rho = at(3, 20);
    for (const double expected :
         {evaluate(kFirst, first, rho, std::vector<double>{1.25}),
          evaluate(kSecond, second, rho, std::vector<double>{0.75}), evaluate(kThird, third, rho, {}),
          evaluate(kThird, third, 0.5, {}), evaluate(kThird, third, 0.25, {})}) {
      double value = -1;
      REQUIRE(lines >> value);
      CHECK(value == Approx(expected).margin(4e-6));  // discretisation of floats
    }
  }
}

TEST_CASE("a shader compiler takes all forms", "[forms][user-form]") {
  if (std::system("command -v glslangValidator > /dev/null") != 0) {
    WARN("SKIPPED: no glslangValidator here (scripts/install-packages --tests)");
    return;
  }
  const auto language = GENERATE(ShaderLanguage::glsl, ShaderLanguage::hlsl);
  const bool is_glsl = language == ShaderLanguage::glsl;
  const ScratchFolder scratch;
  const std::string call = "heightlight_third(0.5, 0.5, 0.5, ";
  write_text(scratch / "shader.frag",
             is_glsl ? "#version 450\nlayout(location = 0) out vec4 colour;\n" + shaders(language) +
                           "void main() { colour = vec4(" + call + "vec3(0.5)), 1.0); }\n"
                     : shaders(language) + "float4 main() : SV_Target { return float4(" + call +
                           "float3(0.5, 0.5, 0.5)), 1.0); }\n");
  const std::string command = "cd '" + scratch.path().string() + "' && glslangValidator " +
                              (is_glsl ? "-V" : "-V -D -e main") +
                              " -S frag -o shader.spv shader.frag > log 2>&1";
  const int status = std::system(command.c_str());
  INFO(read_text(scratch / "log"));
  CHECK(status == 0);
}

}  // namespace heightlight
