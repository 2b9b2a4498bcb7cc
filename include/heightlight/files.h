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

// Reading heightmaps from files, and curves to and from tables: the library heightlight::files, built on
// heightlight::core.

namespace heightlight {

/// How the samples of a file become heights. An absent value takes the default that its field names.
struct LoadOptions {
  /// > 0, world units: height from the lowest to the highest place of the result. By default, levels without
  /// a unit are stretched to width / 10, and other samples are not stretched.
  std::optional<double> relief = {};
  std::optional<double> relief_share = {};  ///< > 0; the relief divided by the width. Excludes `relief`
  std::optional<double> width = {};  ///< > 0; extent of the columns, world units. Default 1. Excludes `texel`
  /// Spacing, world units. The default is the spacing that the file gives, in the unit of its heights
  /// (degrees become metres); else width / columns.
  std::optional<Spacing> texel = {};
  std::optional<Boundary> boundary = {};  ///< default `open` where the file gives a spacing, else `tile`
  /// Value, as stored in the file, that means "missing", beside the one that the file declares.
  std::optional<double> no_data = {};
  std::optional<std::string> part = {};  ///< part of an EXR of several: its name (any case) or 0-based index
  /// Channel: its name (any case) or 0-based index. The default is the only channel, or grey where all
  /// channels but alpha agree at every texel.
  std::optional<std::string> channel = {};
  /// Columns and rows of raw samples, whose files do not give them. Each is at least 1.
  std::optional<std::array<int, 2>> size = {};
  bool big_endian = false;  ///< raw samples have the highest byte first
  /// > 0; height per stored value, in world units. The stored values are then heights, and are not stretched.
  /// Excludes `relief` and `relief_share`.
  std::optional<double> scale = {};
  /// Height of a stored 0, in world units. The stored values are then heights, with a `scale` of 1 unless it
  /// is given. Excludes `relief` and `relief_share`.
  std::optional<double> offset = {};
  /// The file must give a spacing in degrees, which becomes metres. Without effect where `texel` or `width`
  /// is given.
  bool degrees_in_metres = false;
  int shrink = 1;  ///< the mean of each shrink × shrink samples takes their place; must divide both sides
  bool invert = false;  ///< the file holds depths: the highest value is the lowest place
  /// k of refraction, in [0, 1). Heights are lowered by the Earth's curvature (curve_heights), as the last
  /// step. Absent: they are not.
  std::optional<double> curvature = {};
};

/// Most levels that are counted: as many as 16 bits can distinguish.
constexpr std::size_t kMostLevels = 65536;

/// Facts about a file, before and after it became a heightmap.
struct SourceFacts {
  std::string format;       ///< "png", "esri ascii grid", "openexr", …
  std::string sample_type;  ///< "uint8", "int8", … "int32", "half", "float", "double", "text"
  int bits = 0;             ///< per sample; 0 for text
  bool is_integer = false;  ///< the samples are stored as whole numbers
  /// The samples were levels without a unit, and were mapped to [0, relief].
  bool is_stretched = false;
  bool is_relief_guessed = false;  ///< they were mapped to a relief that nobody gave: a tenth of the width
  /// The file is a TIFF that says that larger numbers are darker; they are taken for lower ground.
  bool white_is_zero = false;
  int channels = 0;
  std::string channel;  ///< the channel that was read: "Y", "R", "grey (R = G = B)"
  /// Number of distinct values among the samples present; kMostLevels + 1 means more than kMostLevels.
  std::size_t levels = 0;
  /// Median distance between neighbouring levels, as stored in the file; 0 where there are more than 1024
  /// levels, or only one.
  double level_step = 0;
  double lowest = 0;  ///< lowest of the samples present, as stored in the file
  double highest = 0;
  /// The no-data value from the header of an Esri grid or GDAL's tag in a TIFF, or −32768 for an SRTM tile;
  /// −9999 for an Esri grid that names none but holds that value.
  std::optional<double> declared_no_data;
  bool no_data_assumed = false;  ///< declared_no_data is that −9999: the file itself names no value
  std::string sha256;            ///< of the file's bytes, hexadecimal
};

/// What a user should know about a file before trusting the results: a message of one line, and a quantity
/// that would help, perhaps with a value, as in Error::remedy.
struct Warning {
  std::string message;
  std::string remedy = {};
};

struct LoadedHeightmap {
  Heightmap map;
  /// Absent where the file gives no place, as ordinary pictures and bare arrays do not.
  std::optional<Georeference> place = {};
  SourceFacts facts;
  std::vector<Warning> warnings;  ///< the most important first
};

/// Throws UsageError for options that are outside their range, or that exclude each other.
void check_load_options(const LoadOptions& options);

/// Returns the bytes that the work on a map of so many columns and rows takes at its worst moment, the map
/// included.
using WorkBytes = std::function<std::uint64_t(int columns, int rows)>;

/// Reads a heightmap. Formats are PNG of 8 and 16 bits, Esri ASCII grids (`.asc`), what OpenImageIO reads
/// (EXR, TIFF, JPEG, TGA, HDR), NumPy arrays (`.npy`), SRTM tiles (`.hgt`), and raw samples (`.raw`, `.r16`
/// …, with `size`). The format is recognised by the file's content; only `.asc`, `.hgt` and raw samples go by
/// the name.
///
/// Integer samples are levels, stretched so that the lowest present becomes 0 and the highest `relief`. These
/// samples are heights, and are stretched in that way only where a relief is given: text and floating-point
/// samples; SRTM tiles; all samples read with a `scale` or an `offset`; with a `texel`, signed integers of at
/// least 16 bits in arrays and TIFFs; integers of a TIFF that has a pixel scale; with a `texel`, integers of
/// at least 16 bits of a TIFF that has a no-data value. A TIFF whose GDAL metadata give a scale and an offset
/// has heights, too, unless the options give others. Heights that were stretched have base 0. A map whose
/// samples are all equal stays level.
///
/// Samples go missing if they are equal to `no_data` or to the value that the file declares (each rounded to
/// the stored type: float, half or integer), NaN, ±infinity, or transparent where no `channel` is given. A
/// mask beside the samples of a TIFF is not read; a warning says so. `shrink` is applied to the heights after
/// stretching, so that the relief of the result may be less; `curvature` comes last. `width` sets the spacing
/// along the rows; along the columns it follows from the proportions of the file's cells.
///
/// Before samples are read, `memory_limit` (bytes) is compared with what reading takes by the size in the
/// header, and with what `work`, if given, says that the work to follow takes. The file is opened once: its
/// checksum is that of the bytes that were read.
///
/// Throws Error naming `path` and the fault: a file that is missing, a directory, empty, truncated, damaged,
/// of no known format, or written to while it was read; 0 × 0 samples, more than 2^31, or more than 10^6 on a
/// side; nothing but missing samples; heights beyond float, or slopes beyond 1e12; several parts without
/// `part`; channels that differ without `channel`; raw samples without `size`; a stored scale that is not
/// positive. Without `texel`, also: a GeoTIFF whose place is rotated, odd or contradicts itself
/// (georeference.h); lengths in another unit than the metre beside heights of an unknown unit; cells in
/// degrees of a body other than the Earth, or of an unknown place; `degrees_in_metres` for a file without
/// degrees. Throws MemoryError naming `path`. Throws UsageError as check_load_options, shrink and
/// curve_heights do, for a `part` or `channel` that the file does not have, and for a `size` where the file
/// gives its own.
LoadedHeightmap load_heightmap(const std::filesystem::path& path, const LoadOptions& options,
                               std::uint64_t memory_limit, const WorkBytes& work = {});

/// Reads a sky (sky_light.h) from an image of floating-point samples: EXR, HDR or TIFF, with the channels
/// grey, or red, green and blue. `memory` is the limit in bytes. Throws Error naming the file and the fault:
/// those that load_heightmap finds in an image; integer samples, which are no radiance; other channels; what
/// check_sky_light refuses. Throws MemoryError as load_heightmap does.
SkyLight load_sky_light(const std::filesystem::path& path, std::uint64_t memory);

/// Writes form factors as a sparse matrix that scipy.sparse.load_npz reads, in compressed rows (`indptr`,
/// `indices`, `data`). Row i holds F_ij, what texel i = row × width + column sees of each texel j. The file
/// also holds `sky_view_factor`, whose entry i and row i sum to 1, and `map_shape` (rows, columns). The rows
/// of missing samples are empty, and their sky view factor is 0. Throws OutputError naming the file.
void write_form_factors(const std::filesystem::path& path, const FormFactors& form_factors);

/// The first line of `curves.csv`: the names of its columns.
constexpr const char* kCurvesHeader = "ao_kind,bin,ao_lo,ao_hi,ao_mean,count,bounce,mean,stddev,p05,p50,p95";

/// Writes `curves.csv`: one line per kind, bin and bounce, in this order, with both kinds below each other
/// and as many digits as a double needs. The tail is not written. Throws OutputError naming the file.
void write_curves_csv(const std::filesystem::path& path, const std::vector<BounceCurves>& curves);

/// Reads a file that write_curves_csv wrote. The columns are found by name, in any order. The file does not
/// hold the tail; its mean is what the means of the bounces leave of 1, and its other statistics are 0.
/// Throws Error naming the file, and the line where there is one, for: a missing column; a number that is
/// malformed, not finite, or outside its range; a kind of AO that is unknown or comes again after the other;
/// bins that are out of order or have no texels; bounces that do not follow each other, or are not as many in
/// all bins; the curves of several runs. The memory it takes grows with the file and has no limit;
/// read_run_curves has one.
std::vector<BounceCurves> read_curves_csv(const std::filesystem::path& path);

/// The curves of one run, in a table of many.
struct RunCurves {
  std::string run;  ///< name of the run; empty where the table has no such column, as `curves.csv`
  std::string map;  ///< name of the map; empty where the table has no such column
  std::vector<BounceCurves> curves;
};

/// Reads `dataset.csv`, the curves of many runs below each other, or `curves.csv`. Throws Error as
/// read_curves_csv does (several runs are allowed here), and for a run that comes again after another. Throws
/// MemoryError naming the file where the curves of so large a file may take more than `memory_limit` bytes.
std::vector<RunCurves> read_run_curves(const std::filesystem::path& path, std::uint64_t memory_limit);

}  // namespace heightlight
