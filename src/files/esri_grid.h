#pragma once

#include <cstdint>
#include <optional>

#include "files/input_file.h"
#include "files/map_size.h"
#include "heightlight/image.h"

namespace heightlight {

/// The header of an Esri ASCII grid.
struct EsriHeader {
  int columns = 0;
  int rows = 0;
  double cell_x = 0;  ///< cell width in the header's unit: metres, degrees, …
  double cell_y = 0;
  std::optional<double> west;   ///< outer edge of the leftmost cells, in the header's unit
  std::optional<double> south;  ///< outer edge of the lowest cells, in the header's unit
  std::optional<double> no_data;
};

struct EsriGrid {
  EsriHeader header;
  Image<double> values;  ///< as written, no-data values included; row 0 is the northern one, as in the file
};

/// Reads a grid. The header's keywords (ncols, nrows, xllcorner or xllcenter, yll…, cellsize or dx and dy,
/// NODATA_value) may come in any order and case; all but ncols, nrows and the cell size may be absent. Values
/// are separated by any white space. The size is checked (check_map_size) before values are read. Throws
/// Error naming the file, the line and the fault: an unknown or repeated keyword, a word that is not a
/// number, or too few or too many values.
EsriGrid read_esri_grid(const InputFile& file, const ReadLimit& limit);

}  // namespace heightlight
