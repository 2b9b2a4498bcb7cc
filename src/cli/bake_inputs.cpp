#include "cli/bake_inputs.h"

#include <fnmatch.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <system_error>

#include "bake/file_name.h"
#include "files/file_record.h"
#include "files/input_file.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

bool has_heightmap_extension(const fs::path& path) {
  static const std::set<std::string> kExtensions{".png", ".exr", ".tif", ".tiff", ".jpg", ".jpeg",
                                                 ".tga", ".hdr", ".asc", ".npy",  ".hgt"};
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return kExtensions.contains(extension);
}

/// As material libraries and bakers name what belongs to a material beside its heights.
bool names_other_map(const std::string& name) {
  static const std::set<std::string> kOthers{
      "color",     "colour",     "basecolor",   "albedo",     "diffuse",   "diff",     "normal",
      "normals",   "nor",        "nrm",         "ao",         "occlusion", "rough",    "roughness",
      "gloss",     "glossiness", "metal",       "smoothness", "metalness", "metallic", "spec",
      "specular",  "opacity",    "emission",    "emissive",   "arm",       "orm",      "preview",
      "thumbnail", "render",     "multibounce", "packed",     "curvature", "cavity",   "convexity",
      "concavity", "sheet"};
  bool other = false;
  for (const std::string& word : words_of(name)) {
    if (is_word_for_heights(word)) return false;
    other = other || kOthers.contains(word);
  }
  return other;
}

/// Names of files that the sidecars in a folder speak of.
std::set<std::string> baked_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; entry != end; entry.increment(failure)) {
    if (!entry->path().filename().string().ends_with("_bake.json")) continue;
    const auto records = read_file_records(entry->path());
    if (!records) continue;
    for (const FileRecord& record : *records) names.insert(record.name);
  }
  return names;
}

void list_folder(const fs::path& folder, const std::string& pattern, std::vector<fs::path>& files,
                 std::vector<fs::path>& left_out) {
  const std::set<std::string> baked = baked_in(folder);
  const std::size_t before = files.size();
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; entry != end; entry.increment(failure)) {
    const fs::path& path = entry->path();
    const std::string name = path.filename().string();
    std::error_code ignored;
    if (!has_heightmap_extension(path) || entry->is_directory(ignored)) continue;
    if (pattern.empty() && baked.contains(name)) continue;
    if (!pattern.empty() && fnmatch(pattern.c_str(), name.c_str(), 0) != 0) continue;
    if (pattern.empty() && names_other_map(path.stem().string())) {
      left_out.push_back(path);
    } else {
      files.push_back(path);
    }
  }
  if (failure) throw file_error(folder, "cannot be read: " + failure.message());
  if (files.size() == before) {
    throw file_error(folder,
                     left_out.empty() ? "contains no heightmap"
                                      : "contains no heightmap: all files are named like other kinds of maps",
                     left_out.empty() ? "" : "pattern");
  }
  std::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end());
  std::sort(left_out.begin(), left_out.end());
}

}  // namespace

BakeInputs list_bake_inputs(const std::vector<fs::path>& named, const std::string& pattern) {
  BakeInputs listed;
  std::vector<BakeInput>& inputs = listed.inputs;
  for (const fs::path& path : named) {
    std::error_code ignored;
    std::vector<fs::path> files;
    if (fs::is_directory(path, ignored)) {
      list_folder(path, pattern, files, listed.left_out);
    } else {
      files.push_back(path);
    }
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
  return listed;
}

}  // namespace heightlight
