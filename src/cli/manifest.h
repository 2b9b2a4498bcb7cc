#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/simulation.h"
#include "heightlight/files.h"

namespace heightlight {

/// One heightmap of a manifest: a file, or a shape to be made.
struct ManifestMap {
  std::string name;            ///< unlike any other's
  std::string source;          ///< the file as the manifest names it, or the shape
  std::filesystem::path file;  ///< empty for a shape
  int size = 512;              ///< of a shape
  std::uint64_t seed = 1;      ///< of a shape
  LoadOptions load;            ///< with the map's own relief and boundary

  bool is_shape() const { return file.empty(); }
};

/// One way of simulating.
struct ManifestOptions {
  std::string name;               ///< may be empty where it is the only one
  std::string albedo_file;        ///< as the manifest names it; empty where the albedo is a constant
  SimulateOptions simulate = {};  ///< all but the map, the folder, threads and memory
};

/// Every map with every relief, boundary and set of options.
struct Manifest {
  std::filesystem::path path;
  std::vector<ManifestMap> maps;
  std::vector<std::optional<double>> relief_shares;  ///< relief over width; nothing: the map's own
  std::vector<std::optional<Boundary>> boundaries;   ///< nothing: the map's own
  std::vector<ManifestOptions> options;
};

/// Reads a manifest (format: `describe_manifest`). Throws Error naming the file and the place in it for
/// whatever can be found wrong without looking at the maps.
Manifest read_manifest(const std::filesystem::path& path);

/// What a manifest looks like, for the user.
std::string describe_manifest();

}  // namespace heightlight
