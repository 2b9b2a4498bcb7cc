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

/// {"file": …, "bytes": …, "sha256": …}, an entry of the key `files`; with `file_hex`, the name's bytes,
/// where those are no UTF-8, which JSON cannot hold.
nlohmann::ordered_json describe_file(const FileRecord& record);

/// The key `files` of such JSON; nothing where there is none. Entries with a folder or a zero byte in their
/// name, which this program does not write, are left out.
std::optional<std::vector<FileRecord>> parse_file_records(const nlohmann::json& all);

/// Likewise of a file; nothing where that is absent or damaged.
std::optional<std::vector<FileRecord>> read_file_records(const std::filesystem::path& json);

/// Whether the folder still holds the file as it was recorded.
bool is_as_recorded(const std::filesystem::path& folder, const FileRecord& record);

}  // namespace heightlight
