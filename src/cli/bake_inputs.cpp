#include "cli/bake_inputs.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "files/input_file.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

bool has_heightmap_extension(const fs::path& path) {
  static const std::set<std::string> kExtensions{".png",  ".exr", ".tif", ".tiff", ".jpg",
                                                 ".jpeg", ".tga", ".hdr", ".asc"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kExtensions.contains(extension);
}

/// Names of files that a sidecar speaks of; none where it is not one.
void add_baked(const fs::path& sidecar, std::set<std::string>& names) {
  std::ifstream file(sidecar);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("files") || !json["files"].is_array()) return;
  for (const nlohmann::json& entry : json["files"]) {
    if (entry.is_object() && entry.contains("file") && entry["file"].is_string()) {
      names.insert(entry["file"].get<std::string>());
    }
  }
}

std::vector<fs::path> list_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::set<std::string> baked;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    if (!entry.is_regular_file()) continue;
    if (entry.path().filename().string().ends_with("_bake.json")) add_baked(entry.path(), baked);
    if (has_heightmap_extension(entry.path())) files.push_back(entry.path());
  }
  if (failure) throw file_error(folder, "cannot be read: " + failure.message());
  std::erase_if(files, [&](const fs::path& path) { return baked.contains(path.filename().string()); });
  if (files.empty()) throw file_error(folder, "there is no heightmap in it");
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<BakeInput> list_bake_inputs(const std::vector<fs::path>& named) {
  std::vector<BakeInput> inputs;
  for (const fs::path& path : named) {
    std::error_code ignored;
    const std::vector<fs::path> files =
        fs::is_directory(path, ignored) ? list_folder(path) : std::vector<fs::path>{path};
    for (const fs::path& file : files) inputs.push_back({file, file.stem().string()});
  }
  std::map<std::string, fs::path> by_name;
  for (const BakeInput& input : inputs) {
    const auto [other, is_new] = by_name.emplace(input.name, input.path);
    if (!is_new) {
      throw UsageError(input.path.string() + " and " + other->second.string() +
                       ": both would be written as " + input.name + "_…; bake them into different folders");
    }
  }
  return inputs;
}

}  // namespace heightlight
