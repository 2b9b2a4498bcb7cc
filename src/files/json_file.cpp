#include "files/json_file.h"

#include <set>
#include <string>
#include <vector>

#include "files/input_file.h"
#include "files/named.h"
#include "files/printable.h"

namespace heightlight {
namespace {

constexpr std::size_t kLargestFile = 16 << 20;

std::string read_all(const std::filesystem::path& path) {
  const File file = open_input(path);
  std::string text;
  std::vector<char> block(1 << 16);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    text.append(block.data(), count);
    if (text.size() > kLargestFile) throw file_error(path, "is too large for what it should hold");
  }
  if (std::ferror(file.get())) throw file_error(path, "cannot be read to its end");
  return text;
}

/// The library's message without the tag in brackets at its beginning.
std::string without_tag(const std::string& message) {
  const std::size_t tag_end = message.find("] ");
  return tag_end == std::string::npos ? message : message.substr(tag_end + 2);
}

constexpr int kDeepest = 64;

/// Receives the events of the parser, and keeps the keys of every object that is still open.
class ParseGuard {
 public:
  explicit ParseGuard(const std::filesystem::path& path) : path_(path) {}

  void see(int depth, nlohmann::json::parse_event_t event, const nlohmann::json& value) {
    if (depth > kDeepest) throw file_error(path_, "holds values more than 64 deep");
    if (event == nlohmann::json::parse_event_t::object_start) open_.emplace_back();
    if (event == nlohmann::json::parse_event_t::object_end) open_.pop_back();
    if (event != nlohmann::json::parse_event_t::key) return;
    const auto& key = value.get_ref<const std::string&>();
    if (!open_.back().insert(key).second) {
      throw file_error(path_, "the key \"" + printable(key) + "\" stands twice in one object");
    }
  }

 private:
  const std::filesystem::path& path_;
  std::vector<std::set<std::string>> open_;
};

}  // namespace

nlohmann::json read_json(const std::filesystem::path& path) {
  const std::string text = read_all(path);
  refuse_utf16(path, text);
  ParseGuard guard(path);
  try {
    return nlohmann::json::parse(
        text, [&guard](int depth, nlohmann::json::parse_event_t event, nlohmann::json& value) {
          guard.see(depth, event, value);
          return true;
        });
  } catch (const nlohmann::json::exception& error) {
    throw file_error(path, printable(without_tag(error.what())));
  }
}

}  // namespace heightlight
