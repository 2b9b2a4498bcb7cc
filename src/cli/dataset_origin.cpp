#include "cli/dataset_origin.h"

#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

#include "files/evidence_json.h"
#include "files/image_file.h"
#include "files/input_file.h"
#include "files/json_file.h"
#include "files/output_file.h"
#include "files/staged_output.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

/// A text at this place in JSON that somebody may have edited; empty where there is none.
std::string text_at(const nlohmann::json& json, const char* pointer) {
  const nlohmann::json::json_pointer place(pointer);
  return json.contains(place) && json[place].is_string() ? json[place].get<std::string>() : std::string();
}

bool holds(const fs::path& path, const std::string& text) {
  std::ifstream file(path, std::ios::binary);
  return file && std::string(std::istreambuf_iterator<char>(file), {}) == text;
}

}  // namespace

nlohmann::ordered_json describe_origin(const Manifest& manifest) {
  return {
      {"version", HEIGHTLIGHT_VERSION},
      {"manifest", {{"file", manifest.path.filename().string()}, {"sha256", sha256_of_file(manifest.path)}}}};
}

void write_origin(const nlohmann::ordered_json& origin, const fs::path& folder,
                  const std::vector<fs::path>& inputs) {
  const std::string text = json_text(origin);
  if (holds(folder / kOriginFile, text)) return;
  StagedFile file(folder / kOriginFile, inputs);
  write_bytes(file.path(), text);
  file.commit();
}

void check_origin(const nlohmann::ordered_json& origin, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw file_error(folder, "no such folder");
  if (!fs::exists(folder / kOriginFile, ignored))
    throw file_error(folder, std::string("is not the folder of a dataset: it has no ") + kOriginFile);
  const nlohmann::json found = read_json(folder / kOriginFile);
  const nlohmann::json wanted(origin);
  const std::string version = text_at(found, "/version");
  if (version != HEIGHTLIGHT_VERSION) {
    throw file_error(folder, "was made by version \"" + version +
                                 "\", but this is version " HEIGHTLIGHT_VERSION ": do its runs again");
  }
  if (text_at(found, "/manifest/sha256") != text_at(wanted, "/manifest/sha256")) {
    throw file_error(folder, "was made from a manifest other than the current " +
                                 text_at(wanted, "/manifest/file") + ": do its runs again");
  }
}

}  // namespace heightlight
