#pragma once

#include "files/input_file.h"

namespace heightlight {

/// Kinds of file that can hold a heightmap.
enum class FileFormat { png, openexr, tiff, jpeg, hdr, targa, esri_grid };

/// Name as people write it: "png", "openexr", "esri ascii grid", ….
const char* to_string(FileFormat format);

/// Recognises a file by its first bytes; a name in `.asc` makes an Esri grid of what is no image. Throws
/// Error naming the file when it is none of these, with what it is and what to do about it where that can be
/// told.
FileFormat recognise_format(const InputFile& file);

}  // namespace heightlight
