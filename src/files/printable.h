#pragma once

#include <filesystem>
#include <string>

namespace heightlight {

/// Text from outside (names of files, what files say), fit for one line of a terminal, a table or an XML
/// file:
/// '?' stands for control characters, for bytes that are no UTF-8, and for code points that XML 1.0 (2.2) has
/// not.
std::string printable(const std::string& text);

/// A path likewise.
inline std::string printable(const std::filesystem::path& path) { return printable(path.string()); }

}  // namespace heightlight
