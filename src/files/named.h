#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "files/input_file.h"

namespace heightlight {

/// Compares names of ASCII letters without regard to case.
bool equal_names(const std::string& a, const std::string& b);

/// Joins names to one text: "R, G, B".
std::string join_names(const std::vector<std::string>& names, const char* between = ", ");

/// Index of the entry of `names` (channels or parts) that `wanted` names (any case) or counts (from 0).
/// Throws UsageError naming the file and the entries that exist; `kind` is "channel" or "part".
std::size_t find_named(const char* kind, const InputFile& file, const std::vector<std::string>& names,
                       const std::string& wanted);

/// The byte-order mark of UTF-8, which some editors put at the beginning of a text.
inline constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

/// Throws Error naming the file if the text begins with the byte-order mark of UTF-16.
void refuse_utf16(const std::filesystem::path& path, std::string_view head);

}  // namespace heightlight
