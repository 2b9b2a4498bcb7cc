#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace heightlight {

/// A heightmap to bake, and what its files' names begin with: its own without the extension.
struct BakeInput {
  std::filesystem::path path;
  std::string name;
};

/// What a batch bakes.
struct BakeInputs {
  std::vector<BakeInput> inputs;
  std::vector<std::filesystem::path> left_out;  ///< of folders: by their names no heights
};

/// The files named, and of each folder named those with the extension of a heightmap, by name. Of a folder's,
/// `pattern` (a glob, empty for none) chooses; without it, what a sidecar there says was baked is left out,
/// and what its name calls something else (colour, normal, roughness, ao …). What cannot be looked at stays:
/// its baking fails by itself. Throws UsageError where two inputs would write the same files, Error for a
/// folder that holds none.
BakeInputs list_bake_inputs(const std::vector<std::filesystem::path>& named, const std::string& pattern);

}  // namespace heightlight
