#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/curves.h"
#include "heightlight/georeference.h"
#include "heightlight/heightmap.h"
#include "heightlight/sky_light.h"
#include "heightlight/transport.h"

// Heightmaps from files, and curves to and from tables: the library heightlight::files, on top of
// heightlight::core.

namespace heightlight {

/// How the samples of a file become heights. Absent values take the defaults that each field names.
struct LoadOptions {
  /// > 0; peak-to-valley of the result. Levels without a unit: width / 10; others: as they are
  std::optional<double> relief = {};
  std::optional<double> relief_share = {};  ///< > 0; the same over the width. Excludes `relief`
  std::optional<double> width = {};  ///< > 0; extent of the columns, world units. Default 1. Excludes `texel`
  std::optional<Spacing> texel =
      {};  ///< spacing; default what the file tells, in the unit of its heights, else width / columns
  std::optional<Boundary> boundary = {};    ///< default `open` where the file tells a spacing, else `tile`
  std::optional<double> no_data = {};       ///< the value, as stored in the file, that means "missing"
  std::optional<std::string> part = {};     ///< of an EXR of several: name (any case) or 0-based index
  std::optional<std::string> channel = {};  ///< name (any case) or 0-based index; default: the only one, or
                                            ///< grey where all agree at every texel (alpha left out)
  std::optional<std::array<int, 2>> size =
      {};                   ///< columns and rows of raw samples, which tell none themselves
  bool big_endian = false;  ///< of raw samples: the highest byte first
  /// > 0; height per stored value, in world units: what is stored are then heights, and nothing is stretched.
  /// Excludes `relief` and `relief_share`
  std::optional<double> scale = {};
  std::optional<double> offset =
      {};                          ///< height of a stored 0, world units; with a scale of 1 where it is alone
  bool degrees_in_metres = false;  ///< the file must tell a spacing in degrees, which becomes metres
  int shrink = 1;       ///< means of shrink × shrink samples take their place; must divide both sides
  bool invert = false;  ///< the file holds depths: the highest value is the lowest place
  std::optional<double> curvature =
      {};  ///< refraction k: heights are lowered by the Earth's curvature (curve_heights), last of all
};

/// Levels are counted up to here: as many as 16 bits can tell apart.
constexpr std::size_t kMostLevels = 65536;

/// What a file turned out to hold, before and after it became a heightmap.
struct SourceFacts {
  std::string format;              ///< "png", "esri ascii grid", "openexr", …
  std::string sample_type;         ///< "uint8", "int8", … "int32", "half", "float", "double", "text"
  int bits = 0;                    ///< per sample; 0 for text
  bool is_integer = false;         ///< samples are whole numbers
  bool is_stretched = false;       ///< they are levels without a unit, mapped to [0, relief]
  bool is_relief_guessed = false;  ///< to a relief that nobody gave: a tenth of the width
  bool white_is_zero = false;      ///< of a TIFF that says so: larger numbers are darker, and lower
  int channels = 0;
  std::string channel;  ///< what was read: "Y", "R", "grey (R = G = B)"
  std::size_t levels =
      0;  ///< distinct values among the samples present; kMostLevels + 1 means more than kMostLevels
  double level_step = 0;  ///< median distance between neighbouring levels; 0 where they are not few
  double lowest = 0;      ///< of the samples present, as stored in the file
  double highest = 0;
  /// From the header of an Esri grid, or GDAL's tag in a TIFF; −9999 in a grid that names none.
  std::optional<double> declared_no_data;
  bool no_data_assumed = false;  ///< that −9999: the file itself says nothing
  std::string sha256;            ///< of the file's bytes, hexadecimal
};

/// What a user should know of a file before believing what is made of it: one line, and a quantity that would
/// help, with a value, as Error::remedy has it.
struct Warning {
  std::string message;
  std::string remedy = {};
};

struct LoadedHeightmap {
  Heightmap map;
  std::optional<Georeference> place =
      {};  ///< absent where the file tells none: it is no terrain, or a bare array
  SourceFacts facts;
  std::vector<Warning> warnings;  ///< most weighty first
};

/// Throws UsageError for options outside their range, or that exclude each other.
void check_load_options(const LoadOptions& options);

/// Bytes that work on a map of so many columns and rows takes at its worst moment, the map included.
using WorkBytes = std::function<std::uint64_t(int columns, int rows)>;

/// Reads a heightmap: PNG of 8 and 16 bits, Esri ASCII grids (`.asc`), what OpenImageIO reads (EXR, TIFF,
/// JPEG, TGA, HDR), NumPy arrays (`.npy`), SRTM tiles (`.hgt`) and raw samples (`.raw`, `.r16` …, with
/// `size`). The format follows from the file's content, not from its name, save for `.asc`, `.hgt` and raw
/// samples. Integer samples are stretched so that the lowest present is 0 and the highest `relief`; float
/// samples are heights, and so are SRTM's, all that have a `scale` or an `offset`, signed integers with a
/// `texel`, and integers of a TIFF that has a pixel scale, or a `texel` and no-data: they are stretched
/// likewise only where `relief` is given. A TIFF whose metadata (GDAL's) give a scale and an offset has
/// heights, too, unless the options give others; a mask beside its samples is not read, of which a warning
/// tells. What is stretched has base 0; a level map stays level. Samples equal to `no_data` or to the value
/// that the file itself declares, each as the stored type sees it (the nearest float, half or integer), NaN,
/// ±infinity and transparent ones go missing. `shrink` comes last, on heights as stretched, so that the
/// relief of what is left may be less. `width` sets the spacing along the rows, and that of an Esri grid
/// along the columns in proportion. Before samples are read, `memory_limit` (bytes) is checked against
/// what reading takes by the header's size, and what the `work` to come says it takes. The file is opened
/// once: its checksum is that of the bytes that were read. Throws Error naming `path` and what is wrong:
/// missing, a directory, empty, truncated or damaged, no known format, 0 × 0, larger than 2^31 samples,
/// nothing but missing samples, heights beyond float, several parts without `part`, channels that differ
/// without `channel`, without `texel` a GeoTIFF whose place is rotated, odd or contradicts itself
/// (georeference.h) or lengths in feet beside heights of an unknown unit or degrees of another body than the
/// Earth, raw samples without `size`, written to while it was read; MemoryError naming `path`; UsageError as
/// check_load_options does, and for a `part` or `channel` that the file does not have.
LoadedHeightmap load_heightmap(const std::filesystem::path& path, const LoadOptions& options,
                               std::uint64_t memory_limit, const WorkBytes& work = {});

/// Reads a sky (sky_light.h) from an image of floating-point samples: EXR, HDR, or TIFF; grey, or red, green
/// and blue. Throws Error naming the file and what is wrong: all that load_heightmap finds wrong with an
/// image, samples of 8 or 16 bits, which are no radiance, other channels, or what check_sky_light refuses.
SkyLight load_sky_light(const std::filesystem::path& path, std::uint64_t memory);

/// Writes form factors as a sparse matrix, which scipy.sparse.load_npz reads: compressed rows (`indptr`,
/// `indices`, `data`), row i for what texel i = row × width + column sees of each texel, and beside it
/// `sky_view_factor`, so that each row of the matrix and that sum to 1, and `map_shape` (rows, columns). Rows
/// of missing samples are empty, and 0. Throws Error naming the file.
void write_form_factors(const std::filesystem::path& path, const FormFactors& form_factors);

/// The first line of `curves.csv`.
constexpr const char* kCurvesHeader = "ao_kind,bin,ao_lo,ao_hi,ao_mean,count,bounce,mean,stddev,p05,p50,p95";

/// Writes `curves.csv`: one line per kind, bin and bounce, in this order,
/// both kinds below each other, numbers with as many digits as a double needs. Throws Error naming the file.
void write_curves_csv(const std::filesystem::path& path, const std::vector<BounceCurves>& curves);

/// Reads such a file back: the columns by their names, in any order. The tail, which it does not hold, is
/// what the means leave of 1. Throws Error naming the file, and the line, for a column that is missing, a
/// number that is none or not finite, a kind of AO that is unknown or comes again after the other, bins out
/// of order or without texels, bounces that don't follow on each other or of which bins have unlike numbers,
/// and for the curves of several runs. Takes memory as the file's size asks for; read_run_curves bounds it.
std::vector<BounceCurves> read_curves_csv(const std::filesystem::path& path);

/// The curves of one run in a table of many.
struct RunCurves {
  std::string run;  ///< empty where the table has no such column: `curves.csv`
  std::string map;  ///< likewise
  std::vector<BounceCurves> curves;
};

/// Reads `dataset.csv`, the curves of many runs below each other, or `curves.csv`. Throws Error as
/// read_curves_csv does, for a run that comes again after another, and, naming it, where `memory_limit` bytes
/// may not hold what so large a file becomes.
std::vector<RunCurves> read_run_curves(const std::filesystem::path& path, std::uint64_t memory_limit);

}  // namespace heightlight
