#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heightlight {

/// A file of results as the JSON beside it tells: what was written there, and may since have been cut short,
/// edited or replaced by another run's.
struct FileRecord {
  std::string name = {};  ///< without folder
  std::uint64_t bytes = 0;
  std::string sha256 = {};  ///< hexadecimal
};

/// Of a file as it is now; `path` is its place, `name` what it is or will be called. Throws Error.
FileRecord record_file(const std::filesystem::path& path, const std::string& name);

/// {"file": …, "bytes": …, "sha256": …}, an entry of the key `files`.
nlohmann::ordered_json describe_file(const FileRecord& record);

/// The key `files` of a file of JSON beside results; nothing where the file is absent, is damaged or has no
/// such key. Entries with a folder in their name, which this program does not write, are left out.
std::optional<std::vector<FileRecord>> read_file_records(const std::filesystem::path& json);

/// Whether the folder still holds the file as it was recorded.
bool is_as_recorded(const std::filesystem::path& folder, const FileRecord& record);

}  // namespace heightlight
