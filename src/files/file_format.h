#pragma once

#include "files/input_file.h"

namespace heightlight {

/// Kinds of file that can hold a heightmap.
enum class FileFormat { png, openexr, tiff, jpeg, hdr, targa, esri_grid, numpy, srtm, raw };

/// Whether the format is a picture, which may also hold an albedo or a sky.
bool is_picture(FileFormat format);

/// Name as people write it: "png", "openexr", "esri ascii grid", ….
const char* to_string(FileFormat format);

/// Recognises a file's format by its first bytes. A file that is no image is an Esri grid if its name ends in
/// `.asc`, an SRTM tile if the name ends in `.hgt` and the size is that of a tile, and raw samples if the
/// name has one of the extensions that game engines use for them (`.raw`, `.r16` …). Throws Error naming the
/// file when it is none of these; where possible, the message says what the file is and what to do about it.
FileFormat recognise_format(const InputFile& file);

}  // namespace heightlight
