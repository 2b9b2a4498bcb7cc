#pragma once

#include <optional>
#include <string>

#include "files/geotiff_place.h"
#include "files/input_file.h"

namespace heightlight {

/// What the first directory of a TIFF says beyond what OpenImageIO reports.
struct TiffFacts {
  bool white_is_zero = false;          ///< larger numbers are darker (PhotometricInterpretation 0)
  bool is_cmyk_in_tiles = false;       ///< CMYK in tiles, which crashes OpenImageIO 2.4
  std::optional<std::string> no_data;  ///< GDAL's tag 42113, as text
  std::optional<double> scale;         ///< height per stored value, where GDAL's metadata state it
  std::optional<double> offset;        ///< height of a stored 0, where GDAL's metadata state it
  bool has_mask = false;  ///< whether a directory of the file is a mask of missing samples, which is not read
  GeotiffPlace place;     ///< georeference
};

/// Reads these facts from a classic TIFF or BigTIFF, in either byte order. Throws Error naming the file if
/// its first directory cannot be read.
TiffFacts read_tiff_facts(const InputFile& file);

/// Checks every block before a library reads it. Throws Error naming the file for a block that ends beyond
/// the file, or that is larger than twice its content, since that size would be allocated. Deflated blocks
/// are inflated to their end, where the checksum stands. OpenImageIO and libtiff do not check it, so a
/// flipped bit would be read as different heights. Other compressions have no checksums.
void check_tiff_blocks(const InputFile& file);

}  // namespace heightlight
