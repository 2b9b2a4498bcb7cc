#pragma once

#include <optional>
#include <string>

#include "files/geotiff_place.h"
#include "files/input_file.h"

namespace heightlight {

/// What the first directory of a TIFF says beside what OpenImageIO tells.
struct TiffFacts {
  bool white_is_zero = false;          ///< larger numbers are darker (PhotometricInterpretation 0)
  bool is_cmyk_in_tiles = false;       ///< which ends the process within OpenImageIO 2.4
  std::optional<std::string> no_data;  ///< GDAL's tag 42113, as text
  std::optional<double> scale;         ///< height per stored value, where GDAL's metadata tell it
  std::optional<double> offset;        ///< height of a stored 0, likewise
  bool has_mask = false;               ///< a directory of it is a mask of what is missing, which is not read
  GeotiffPlace place;                  ///< where it lies on earth
};

/// Classic TIFF and BigTIFF, either byte order. Throws Error naming the file where its first directory cannot
/// be read.
TiffFacts read_tiff_facts(const InputFile& file);

/// Looks at every block before a library reads it. Throws Error naming the file for one that ends beyond the
/// file, or is larger than twice what it holds, which would be taken as memory. Deflated ones are inflated to
/// their end, where their checksum stands, which OpenImageIO and libtiff do not look at: a flipped bit would
/// be read as other heights. Other compressions have no checksums.
void check_tiff_blocks(const InputFile& file);

}  // namespace heightlight
