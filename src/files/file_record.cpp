#include "files/file_record.h"

#include <charconv>
#include <system_error>

#include "files/image_file.h"
#include "files/input_file.h"
#include "files/json_file.h"
#include "files/printable.h"

namespace heightlight {
namespace {

std::string to_hexadecimal(const std::string& bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : bytes) (text += kDigits[byte >> 4]) += kDigits[byte & 15];
  return text;
}

std::string from_hexadecimal(const std::string& text) {
  std::string bytes;
  for (std::size_t at = 0; at + 2 <= text.size(); at += 2) {
    unsigned char byte = 0;
    if (std::from_chars(&text[at], &text[at] + 2, byte, 16).ptr != &text[at] + 2) return "";
    bytes += static_cast<char>(byte);
  }
  return bytes;
}

std::string text_of(const nlohmann::json& entry, const char* key) {
  return entry.contains(key) && entry[key].is_string() ? entry[key].get<std::string>() : std::string();
}

std::optional<FileRecord> parse_record(const nlohmann::json& entry) {
  if (!entry.is_object()) return std::nullopt;
  FileRecord record{.name = text_of(entry, "file"), .sha256 = text_of(entry, "sha256")};
  if (entry.contains("file_hex")) record.name = from_hexadecimal(text_of(entry, "file_hex"));
  const std::filesystem::path name = record.name;
  if (name.empty() || name != name.filename() || name == "." || name == ".." ||
      record.name.find('\0') != std::string::npos)
    return std::nullopt;
  if (entry.contains("bytes") && entry["bytes"].is_number_unsigned())
    record.bytes = entry["bytes"].get<std::uint64_t>();
  return record;
}

}  // namespace

FileRecord record_file(const std::filesystem::path& path, const std::string& name) {
  const InputFile file(path);
  return {.name = name, .bytes = file.size(), .sha256 = sha256_of_file(file)};
}

nlohmann::ordered_json describe_file(const FileRecord& record) {
  nlohmann::ordered_json json = {{"file", record.name}, {"bytes", record.bytes}, {"sha256", record.sha256}};
  if (!is_utf8(record.name)) json["file_hex"] = to_hexadecimal(record.name);
  return json;
}

std::optional<std::vector<FileRecord>> parse_file_records(const nlohmann::json& all) {
  if (!all.is_object() || !all.contains("files") || !all["files"].is_array()) return std::nullopt;
  std::vector<FileRecord> records;
  for (const nlohmann::json& entry : all["files"]) {
    if (const std::optional<FileRecord> record = parse_record(entry)) records.push_back(*record);
  }
  return records;
}

std::optional<std::vector<FileRecord>> read_file_records(const std::filesystem::path& json) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(json, ignored)) return std::nullopt;
  try {
    return parse_file_records(read_json(json));
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
