#include "heightlight/shaders.h"

#include <fmt/core.h>

#include <fstream>
#include <memory>

#include "cli/commands.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

std::string library_name(const ShaderLanguageName& language) {
  return std::string("heightlight.") + language.extension;
}

/// Shaders lie among sources of other people's: what was not written here stays.
void refuse_foreign_file(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return;
  std::ifstream file(path, std::ios::binary);
  const std::string mark = shader_library_mark();
  std::string begin(mark.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin != mark)
    throw OutputError(printable(path) + ": exists already and was not written by heightlight shaders");
}

void write_libraries(const std::filesystem::path& folder_path) {
  std::vector<std::string> names;
  for (const ShaderLanguageName& language : kShaderLanguages) names.push_back(library_name(language));
  for (const std::string& name : names) refuse_foreign_file(folder_path / name);
  StagedFolder folder(folder_path, {}, names);
  for (const ShaderLanguageName& language : kShaderLanguages)
    write_bytes(folder.file(library_name(language)), shader_library(language.language));
  folder.commit();
  for (const std::string& name : names) fmt::print("{}\n", printable(folder_path / name));
}

void list_functions() {
  for (const ShaderFunction& function : shader_functions()) {
    std::string arguments;
    for (const ShaderInput& input : function.inputs) {
      const std::string type = input.components > 1 ? " (" + std::to_string(input.components) + ")" : "";
      arguments += (arguments.empty() ? "" : ", ") + input.name + type;
    }
    fmt::print("{}({})\n  {}.\n", function.name, arguments, function.formula);
    if (!function.source.empty()) fmt::print("  Source: {}.\n", function.source);
    if (!function.error.empty()) fmt::print("  Measured error: {}.\n", function.error);
    fmt::print("  In C++: {}.\n", function.twin);
  }
}

}  // namespace

void add_shaders_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "shaders", "Write every formula as functions for GLSL, HLSL, WGSL and Godot shaders");
  auto folder = std::make_shared<std::filesystem::path>();
  command
      ->add_option("-o,--output", *folder,
                   "folder for the files; without this option, the functions are listed")
      ->type_name("DIR");
  command->footer(
      "Writes heightlight.glsl, heightlight.hlsl, heightlight.wgsl and heightlight.gdshaderinc. Each file "
      "holds all\n"
      "functions, since they share parts; compilers leave out functions that are not called. If a file of "
      "such a\n"
      "name exists that this command did not write, nothing is written. docs/shaders.md says what each "
      "function\n"
      "is for.\n"
      "Examples:\n"
      "  heightlight shaders\n"
      "  heightlight shaders -o engine/shaders");
  command->callback([folder] {
    if (folder->empty()) return list_functions();
    write_libraries(*folder);
  });
}

}  // namespace heightlight
