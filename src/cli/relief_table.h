#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/input_file.h"
#include "heightlight/files.h"

namespace heightlight {

/// What one map's relief is, by the map's name.
struct NamedRelief {
  std::string name;  ///< of the heightmap's file, with or without its extension
  double relief = 0;
  std::optional<double> width = {};
};

/// Reads `NAME=RELIEF,…`, or a file with lines of a name, a relief and perhaps a width, parted by commas or
/// by blanks; a line that begins with # is a note, and so may be the first one (name,relief,width). Lengths
/// are as read_length has them. Throws UsageError for the former, Error naming the file and the line for the
/// latter: no number, no positive length, a name that stands there twice, or nothing at all.
std::vector<NamedRelief> read_reliefs(const std::string& text);

/// The line for a map, by its file's name with the extension or without; null where there is none.
const NamedRelief* find_relief(const std::vector<NamedRelief>& reliefs, const std::filesystem::path& map);

}  // namespace heightlight
