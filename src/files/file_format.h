#pragma once

#include "files/input_file.h"

namespace heightlight {

/// Kinds of file that can hold a heightmap.
enum class FileFormat { png, openexr, tiff, jpeg, hdr, targa, esri_grid, numpy, srtm, raw };

/// Whether it is a picture, which may hold an albedo or a sky.
bool is_picture(FileFormat format);

/// Name as people write it: "png", "openexr", "esri ascii grid", ….
const char* to_string(FileFormat format);

/// Recognises a file by its first bytes; a name in `.asc` makes an Esri grid of what is no image, one in
/// `.hgt` with an SRTM tile's size such a tile, and one of those that engines give raw samples (`.raw`,
/// `.r16` …) those. Throws Error naming the file when it is none of these, with what it is and what to do
/// about it where that can be told.
FileFormat recognise_format(const InputFile& file);

}  // namespace heightlight
