#pragma once

#include <filesystem>
#include <optional>

namespace heightlight {

/// The no-data value that GDAL keeps as text in tag 42113 of a TIFF's first directory; empty where there is
/// none, or none that is a number. Classic TIFF and BigTIFF, either byte order. Throws Error when the file
/// can't be opened.
std::optional<double> read_tiff_no_data(const std::filesystem::path& path);

}  // namespace heightlight
