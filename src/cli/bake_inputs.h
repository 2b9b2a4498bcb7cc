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

/// The files named, and of each folder named those with the extension of a heightmap, by name; what a sidecar
/// in that folder says was baked is left out. Throws UsageError where two inputs would write the same files,
/// Error for a folder that holds none.
std::vector<BakeInput> list_bake_inputs(const std::vector<std::filesystem::path>& named);

}  // namespace heightlight
