#include "files/named.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "files/printable.h"

namespace heightlight {

bool equal_names(const std::string& a, const std::string& b) {
  const auto equal = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

std::string join_names(const std::vector<std::string>& names, const char* between) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : between) + name;
  return text;
}

std::size_t find_named(const char* kind, const InputFile& file, const std::vector<std::string>& names,
                       const std::string& wanted) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (equal_names(names[i], wanted)) return i;
  }
  std::size_t index = 0;
  const auto [stop, fault] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  if (fault == std::errc() && stop == wanted.data() + wanted.size() && index < names.size()) return index;
  throw UsageError(
      file.path().string() + ": " +
      printable("has no " + std::string(kind) + " '" + wanted + "'; it has " + join_names(names)));
}

void refuse_utf16(const std::filesystem::path& path, std::string_view head) {
  if (head.starts_with("\xff\xfe") || head.starts_with("\xfe\xff"))
    throw file_error(path, "is text in UTF-16; save it as UTF-8, or as plain ASCII");
}

}  // namespace heightlight
