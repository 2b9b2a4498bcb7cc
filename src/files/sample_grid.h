#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "files/input_file.h"
#include "files/map_size.h"
#include "heightlight/georeference.h"
#include "heightlight/image.h"

namespace heightlight {

/// Samples one after the other, as files without a picture's format keep them: NumPy arrays, SRTM tiles, raw
/// heights of game engines.
struct SampleGrid {
  std::string sample_type;  ///< "uint8", "int16", "float" …
  int bits = 0;
  bool is_integer = false;
  Image<double> values;
  std::optional<Georeference> place;  ///< of an SRTM tile whose name says it
};

/// Reads an array that numpy.save wrote: two dimensions (rows, columns) of integers or floats of 8 to 64
/// bits, either byte order, either layout. The size is checked (check_map_size) before samples are read.
/// Throws Error naming the file that is truncated or damaged, or holds anything else.
SampleGrid read_numpy(const InputFile& file, const ReadLimit& limit);

/// Reads a tile of the Shuttle Radar Topography Mission: signed 16 bits, the highest byte first, metres, 1201
/// or 3601 a side, in cells of 3″ or 1″ whose outermost lie on the degree's border; −32768 is missing. A name
/// such as N45E006.hgt says the south-western corner. Throws Error naming the file that has another size.
SampleGrid read_srtm(const InputFile& file, const ReadLimit& limit);

/// Where such a tile lies, by its name; nothing where the name does not say.
std::optional<Georeference> srtm_place(const InputFile& file);

/// Whether a file is such a tile, by its name and size.
bool is_srtm(const InputFile& file);

/// What no file of raw samples says of itself.
struct RawLayout {
  int width = 0;
  int height = 0;
  bool big_endian = false;
};

/// Reads raw samples: as many bytes each as the file's size leaves for so many, 1 or 2 of an unsigned integer
/// or 4 of a float. Throws Error naming a file of another size.
SampleGrid read_raw(const InputFile& file, const RawLayout& layout, const ReadLimit& limit);

/// What to say of raw samples without a size: with one that would do, where the file is a square of 16 bits.
Error raw_needs_size(const InputFile& file);

}  // namespace heightlight
