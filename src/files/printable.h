#pragma once

#include <filesystem>
#include <string>

namespace heightlight {

/// Text from outside (names of files, what files say), fit for one line of a terminal, a table or an XML
/// file. A '?' stands for each control character, for each byte that is no UTF-8, and for code points that
/// XML 1.0 (2.2) has not.
std::string printable(const std::string& text);

/// A path likewise.
inline std::string printable(const std::filesystem::path& path) { return printable(path.string()); }

/// Whether a text is UTF-8 throughout.
bool is_utf8(const std::string& text);

}  // namespace heightlight
