#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heightlight {

/// A result file as the JSON beside it describes it. The file may since have been truncated, edited or
/// replaced by another run's.
struct FileRecord {
  std::string name = {};  ///< without folder
  std::uint64_t bytes = 0;
  std::string sha256 = {};  ///< hexadecimal
};

/// Records a file as it is now. `path` is where it is; `name` is the name that it has or will have. Throws
/// Error.
FileRecord record_file(const std::filesystem::path& path, const std::string& name);

/// {"file": …, "bytes": …, "sha256": …}, an entry of the key `files`. A name that is not UTF-8, which JSON
/// cannot hold, gets the additional key `file_hex` with the bytes of the name.
nlohmann::ordered_json describe_file(const FileRecord& record);

/// Parses the key `files` of such JSON; empty where there is no such key. Entries whose name contains a
/// folder or a zero byte are left out; this program does not write such names.
std::optional<std::vector<FileRecord>> parse_file_records(const nlohmann::json& all);

/// Reads the key `files` of a JSON file; empty where the file is absent or damaged.
std::optional<std::vector<FileRecord>> read_file_records(const std::filesystem::path& json);

/// Whether the folder still holds the file as recorded (size and checksum).
bool is_as_recorded(const std::filesystem::path& folder, const FileRecord& record);

}  // namespace heightlight
