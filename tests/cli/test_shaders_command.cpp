#include <catch2/catch.hpp>
#include <filesystem>

#include "command.h"
#include "folder_contents.h"
#include "heightlight/shaders.h"

namespace heightlight {

using Catch::Contains;

TEST_CASE("shaders are listed, and written as one file of each language", "[shaders]") {
  const ScratchFolder folder;
  const CommandResult listed = run_command("shaders", folder);
  CHECK(listed.exit_code == 0);
  CHECK(listed.error.empty());
  CHECK(folder.entry_count() == 0);
  for (const ShaderFunction& function : shader_functions()) {
    CHECK_THAT(listed.out, Contains(function.name + '('));
  }
  const CommandResult written = run_command("shaders -o new/shaders", folder);
  CHECK(written.exit_code == 0);
  CHECK(written.error.empty());
  const auto contents = folder_contents(folder / "new/shaders");
  CHECK(contents.size() == 4);
  CHECK(contents.at("heightlight.glsl") == shader_library(ShaderLanguage::glsl));
  CHECK(contents.at("heightlight.hlsl") == shader_library(ShaderLanguage::hlsl));
  CHECK(contents.at("heightlight.wgsl") == shader_library(ShaderLanguage::wgsl));
  CHECK(contents.at("heightlight.gdshaderinc") == shader_library(ShaderLanguage::godot));
  CHECK(run_command("shaders -o new/shaders", folder).exit_code == 0);  // its own files are replaced
  CHECK(folder_contents(folder / "new/shaders") == contents);
}

TEST_CASE("shaders leave files of other people's alone", "[shaders]") {
  const ScratchFolder folder;
  write_text(folder / "heightlight.wgsl", "fn mine() {}\n");
  const CommandResult refused = run_command("shaders -o .", folder);
  CHECK(refused.exit_code == 1);
  CHECK(refused.out.empty());
  CHECK(refused.error ==
        "heightlight: ./heightlight.wgsl: exists already and was not written by heightlight shaders\n");
  CHECK(folder.entry_count() == 1);
  CHECK(read_text(folder / "heightlight.wgsl") == "fn mine() {}\n");
}

TEST_CASE("shaders say in one line what cannot be done", "[shaders]") {
  const ScratchFolder folder;
  write_text(folder / "file", "");
  std::filesystem::create_directories(folder / "taken/heightlight.glsl");
  const std::pair<const char*, int> wrong[] = {{"shaders -o file", 1},
                                               {"shaders -o taken", 1},
                                               {"shaders -o ''", 2},
                                               {"shaders glsl", 2},
                                               {"shaders -o a -o b", 2}};
  const std::ptrdiff_t before = folder.entry_count();
  for (const auto& [arguments, exit_code] : wrong) {
    CAPTURE(arguments);
    const CommandResult result = run_command(arguments, folder);
    CHECK(result.exit_code == exit_code);
    CHECK(result.out.empty());
    CHECK(std::count(result.error.begin(), result.error.end(), '\n') == 1);
    CHECK_THAT(result.error, Catch::StartsWith("heightlight: "));
    CHECK(folder.entry_count() == before);
  }
}

}  // namespace heightlight
