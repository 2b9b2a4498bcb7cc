#pragma once

#include <cstdint>
#include <optional>

#include "files/input_file.h"
#include "files/map_size.h"
#include "heightlight/image.h"

namespace heightlight {

/// What the header of an Esri ASCII grid says.
struct EsriHeader {
  int columns = 0;
  int rows = 0;
  double cell_x = 0;  ///< in the header's unit: metres, degrees, …
  double cell_y = 0;
  std::optional<double> west;   ///< of the outer edge of the leftmost cells, in that unit
  std::optional<double> south;  ///< of the outer edge of the lowest cells
  std::optional<double> no_data;
};

struct EsriGrid {
  EsriHeader header;
  Image<double> values;  ///< as written, no-data included; row 0 is the northern one, as in the file
};

/// Reads a grid. The header's keywords (ncols, nrows, xllcorner or xllcenter, yll…, cellsize or dx and dy,
/// NODATA_value) come in any order and case, and all but ncols, nrows and the cell size may be absent; values
/// are separated by any white space. The size is checked (check_map_size) before values are read. Throws
/// Error naming the file, the line and the fault: an unknown or repeated keyword, a word that is no number,
/// too few or too many values.
EsriGrid read_esri_grid(const InputFile& file, const ReadLimit& limit);

}  // namespace heightlight
