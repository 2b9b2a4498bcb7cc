#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "files/input_file.h"
#include "files/map_size.h"
#include "heightlight/georeference.h"
#include "heightlight/image.h"

namespace heightlight {

/// Samples stored one after the other, in files without a picture format: NumPy arrays, SRTM tiles, raw
/// heights of game engines.
struct SampleGrid {
  std::string sample_type;  ///< "uint8", "int16", "float" …
  int bits = 0;
  bool is_integer = false;
  Image<double> values;
  std::optional<Georeference> place;  ///< of an SRTM tile whose name gives its position
};

/// Reads an array that numpy.save wrote: two dimensions (rows, columns) of integers or floats of 8 to 64
/// bits, in either byte order and either layout. The size is checked (check_map_size) before samples are
/// read. Throws Error naming a file that is truncated or damaged, or holds anything else.
SampleGrid read_numpy(const InputFile& file, const ReadLimit& limit);

/// Reads a tile of the Shuttle Radar Topography Mission: signed 16-bit samples, highest byte first, in
/// metres, 1201 or 3601 on a side. Cells are 3″ or 1″; the outermost samples lie on the degree's border;
/// −32768 is missing. A name such as N45E006.hgt gives the south-western corner. Throws Error naming a file
/// of another size.
SampleGrid read_srtm(const InputFile& file, const ReadLimit& limit);

/// The georeference of an SRTM tile, from its name; empty where the name does not give it.
std::optional<Georeference> srtm_place(const InputFile& file);

/// Whether a file is an SRTM tile, judged by its name and size.
bool is_srtm(const InputFile& file);

/// Properties that a file of raw samples does not state.
struct RawLayout {
  int width = 0;
  int height = 0;
  bool big_endian = false;
};

/// Reads raw samples. The number of bytes per sample follows from the file's size: 1 or 2 for unsigned
/// integers, 4 for floats. Throws Error naming a file of any other size.
SampleGrid read_raw(const InputFile& file, const RawLayout& layout, const ReadLimit& limit);

/// The error for raw samples without a size. It suggests a size if the file is a square of 16-bit samples.
Error raw_needs_size(const InputFile& file);

}  // namespace heightlight
