#include "files/file_record.h"

#include <system_error>

#include "files/image_file.h"
#include "files/input_file.h"
#include "files/json_file.h"

namespace heightlight {
namespace {

std::optional<FileRecord> parse_record(const nlohmann::json& entry) {
  if (!entry.is_object() || !entry.contains("file") || !entry["file"].is_string()) return std::nullopt;
  FileRecord record{.name = entry["file"].get<std::string>()};
  const std::filesystem::path name = record.name;
  if (name.empty() || name != name.filename() || name == "." || name == "..") return std::nullopt;
  if (entry.contains("bytes") && entry["bytes"].is_number_unsigned())
    record.bytes = entry["bytes"].get<std::uint64_t>();
  if (entry.contains("sha256") && entry["sha256"].is_string())
    record.sha256 = entry["sha256"].get<std::string>();
  return record;
}

}  // namespace

FileRecord record_file(const std::filesystem::path& path, const std::string& name) {
  const InputFile file(path);
  return {.name = name, .bytes = file.size(), .sha256 = sha256_of_file(file)};
}

nlohmann::ordered_json describe_file(const FileRecord& record) {
  return {{"file", record.name}, {"bytes", record.bytes}, {"sha256", record.sha256}};
}

std::optional<std::vector<FileRecord>> read_file_records(const std::filesystem::path& json) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(json, ignored)) return std::nullopt;
  try {
    const nlohmann::json all = read_json(json);
    if (!all.is_object() || !all.contains("files") || !all["files"].is_array()) return std::nullopt;
    std::vector<FileRecord> records;
    for (const nlohmann::json& entry : all["files"]) {
      if (const std::optional<FileRecord> record = parse_record(entry)) records.push_back(*record);
    }
    return records;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    return std::nullopt;
  }
}

bool is_as_recorded(const std::filesystem::path& folder, const FileRecord& record) {
  std::error_code failure;
  const std::filesystem::path path = folder / record.name;
  if (!std::filesystem::is_regular_file(path, failure)) return false;
  if (std::filesystem::file_size(path, failure) != record.bytes || failure) return false;
  try {
    return sha256_of_file(path) == record.sha256;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace heightlight
