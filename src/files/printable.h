#pragma once

#include <filesystem>
#include <string>

namespace heightlight {

/// Makes text from outside (file names, contents of files) fit for one line of a terminal, a table or an XML
/// file. Each control character, each byte that is not UTF-8, and each code point that XML 1.0 (2.2) does not
/// allow becomes a '?'.
std::string printable(const std::string& text);

/// As above, for a path.
inline std::string printable(const std::filesystem::path& path) { return printable(path.string()); }

/// Whether a text is UTF-8 throughout.
bool is_utf8(const std::string& text);

}  // namespace heightlight
