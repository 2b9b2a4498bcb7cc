#pragma once

#include <filesystem>
#include <string>

#include "heightlight/georeference.h"

namespace heightlight {

/// The text of the .prj beside a grid as it stands there: keywords are one to a line. Empty where there is
/// none, or where it is larger than such a file gets.
std::string read_projection_text(const std::filesystem::path& grid);

/// Notes in `place` what such a text says: degrees or the unit of length, the unit of heights where it has a
/// vertical system, too, the ellipsoid, and the code of the horizontal system in the EPSG register or its
/// name. Both forms are understood, well-known text (OGC 01-009 and 18-010; of a compound or bound system,
/// that of its first part) and the older list of keywords; a text that is neither says nothing.
void note_projection(const std::string& text, Georeference& place);

}  // namespace heightlight
