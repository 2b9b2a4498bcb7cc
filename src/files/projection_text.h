#pragma once

#include <filesystem>
#include <string>

#include "heightlight/georeference.h"

namespace heightlight {

/// Reads the .prj file beside a grid, unchanged: its keywords stand one to a line. Empty where there is no
/// such file, or where it is too large for one.
std::string read_projection_text(const std::filesystem::path& grid);

/// Notes in `place` what a projection text says: degrees or the unit of length, the unit of heights if it
/// also has a vertical system, the ellipsoid, and the horizontal system's EPSG code or name. Two forms are
/// understood: well-known text (OGC 01-009 and 18-010; of a compound or bound system, its first part) and the
/// older list of keywords. Nothing is noted for text in neither form.
void note_projection(const std::string& text, Georeference& place);

}  // namespace heightlight
