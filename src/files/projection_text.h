#pragma once

#include <filesystem>
#include <string>

#include "heightlight/georeference.h"

namespace heightlight {

/// The text of the .prj beside a grid, line breaks left out; empty where there is none, or where it is larger
/// than such a file gets.
std::string read_projection_text(const std::filesystem::path& grid);

/// Notes in `place` what such a text says: degrees or the unit of length, and the system's code in the EPSG
/// register or its name. Both forms are understood, well-known text (OGC 01-009) and the older list of
/// keywords; a text that is neither says nothing.
void note_projection(const std::string& text, Georeference& place);

}  // namespace heightlight
