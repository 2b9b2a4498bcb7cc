#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "heightlight/shaders.h"
#include "scratch_folder.h"
#include "shaders/shader_program.h"
#include "shaders/trial_function.h"
#include "user_form/user_form.h"

// What is not executed is validated at least: WGSL by Dawn's compiler, which is Chromium's, and Godot's
// language by the Godot that Debian has.

namespace heightlight {
namespace {

constexpr const char* kFolder = HEIGHTLIGHT_SOURCE_DIR "/tests/shaders/";
constexpr const char* kDawn = HEIGHTLIGHT_SOURCE_DIR "/build/npm/node_modules/webgpu";

/// What a compiler says of a shader.
struct Verdict {
  int status = -1;
  std::string said;
};

Verdict run_shell(const std::string& command, const ScratchFolder& scratch) {
  const int status = std::system(
      ("cd '" + scratch.path().string() + "' && { " + command + "; } > log 2>&1 < /dev/null").c_str());
  return {status, read_text(scratch / "log")};
}

Verdict validate_wgsl(const std::string& text) {
  const ScratchFolder scratch;
  write_text(scratch / "shader.wgsl", text);
  return run_shell(std::string("node '") + kFolder + "validate_wgsl.mjs' '" + kDawn + "' shader.wgsl",
                   scratch);
}

Verdict compile_in_godot(const std::string& text) {
  const ScratchFolder scratch;
  for (const char* file : {"project.godot", "compile.tscn", "compile.gd"})
    std::filesystem::copy_file(std::string(kFolder) + "godot/" + file, scratch / file);
  write_text(scratch / "library.txt", text);
  return run_shell(
      "HOME=$PWD LIBGL_ALWAYS_SOFTWARE=1 timeout 60 xvfb-run -a godot3-runner --path . --audio-driver Dummy",
      scratch);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// The forms of a user's as they come out of a fit.
std::string fitted_text(ShaderLanguage language) {
  return shader_text(
      language, {},
      user_form_functions(parse_user_form("mine = A^k + (A - 0.5)^3 + mod(rho, 0.7) + mix(n, alpha, "
                                          "frac(3*A))*rsqrt(1 + A)*saturate(n)"),
                          {1.25}));
}

}  // namespace

TEST_CASE("glslang takes the GLSL from 1.30 on, and in GLSL ES 3.00", "[shaders]") {
  if (!has_command("glslangValidator")) {
    WARN("SKIPPED: no glslangValidator here (scripts/install-packages --tests)");
    return;
  }
  for (const char* head : {"#version 130\n", "#version 300 es\nprecision highp float;\n"}) {
    const ScratchFolder scratch;
    write_text(scratch / "shader.frag",
               head + shader_library(ShaderLanguage::glsl) +
                   "out vec4 colour;\nvoid main() {\n  colour = vec4(multi_bounce(vec2(0.5, "
                   "0.5), vec3(0.5)), 1.0);\n}\n");
    const Verdict verdict = run_shell("glslangValidator shader.frag", scratch);
    INFO(verdict.said);
    CHECK(verdict.status == 0);
  }
}

TEST_CASE("Dawn finds the WGSL valid", "[shaders]") {
  if (!has_command("node") || !std::filesystem::exists(kDawn)) {
    WARN(
        "SKIPPED: WGSL is not validated: no node, or no npm package webgpu in build/npm here "
        "(scripts/install-packages --tests)");
    return;
  }
  const std::string library = shader_library(ShaderLanguage::wgsl);
  for (const std::string& text :
       {library, fitted_text(ShaderLanguage::wgsl), stored_pair_shader(ShaderLanguage::wgsl),
        print_shader({trial_function()}, ShaderLanguage::wgsl)}) {
    const Verdict verdict = validate_wgsl(text);
    INFO(verdict.said);
    CHECK(verdict.status == 0);
  }
  const Verdict verdict =
      validate_wgsl(replaced(library, "heightlight_share(sky)", "heightlight_shore(sky)"));
  CHECK(verdict.status != 0);
  CHECK_THAT(verdict.said, Catch::Contains("heightlight_shore"));
}

TEST_CASE("Godot compiles what it is to include", "[shaders]") {
  for (const char* command : {"godot3-runner", "xvfb-run"}) {
    if (has_command(command)) continue;
    WARN("SKIPPED: Godot's shaders are not compiled: no " << command
                                                          << " here (scripts/install-packages --tests)");
    return;
  }
  const std::string library = shader_library(ShaderLanguage::godot);
  for (const std::string& text :
       {library, fitted_text(ShaderLanguage::godot) +
                     "float heightlight_cone_sh_8(float a, vec3 b) { return a * b.x; }\n"}) {
    const Verdict verdict = compile_in_godot(text);
    INFO(verdict.said);
    CHECK_THAT(verdict.said, Catch::Contains("drawn") && !Catch::Contains("SHADER ERROR"));
  }
  const Verdict verdict =
      compile_in_godot(replaced(library, "heightlight_share(sky)", "heightlight_shore(sky)"));
  CHECK_THAT(verdict.said, Catch::Contains("SHADER ERROR"));
}

}  // namespace heightlight
