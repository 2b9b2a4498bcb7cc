#pragma once

#include <filesystem>

namespace heightlight {

/// Kinds of file that can hold a heightmap.
enum class FileFormat { png, openexr, tiff, jpeg, hdr, targa, esri_grid };

/// Name as people write it: "png", "openexr", "esri ascii grid", ….
const char* to_string(FileFormat format);

/// Recognises a file by its first bytes; a name in `.asc` makes an Esri grid of what is no image. Throws
/// Error naming the file when it can't be read or is none of these.
FileFormat recognise_format(const std::filesystem::path& path);

}  // namespace heightlight
