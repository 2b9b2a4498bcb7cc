#pragma once

#include <filesystem>

// Files that appear whole, whoever else writes the same ones meanwhile.

namespace heightlight {

/// Where a file is written until it is whole: a name that no other process has, on whatever machine.
std::filesystem::path unfinished(const std::filesystem::path& file);

/// Gives the file written there its own name. Throws OutputError.
void appear(const std::filesystem::path& file);

}  // namespace heightlight
