#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/channel.h"
#include "files/degrees.h"
#include "files/image_file.h"
#include "files/image_read.h"
#include "files/input_file.h"
#include "files/level_count.h"
#include "heightlight/error.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// A file's samples on their way to heights.
struct StoredHeights {
  Image<double> values;
  SourceFacts facts;
  std::optional<EsriHeader> grid;  ///< of an Esri grid
};

void check_positive(const char* quantity, const std::optional<double>& value) {
  if (value && !(*value > 0 && std::isfinite(*value))) {
    throw UsageError(quantity, "", "must be a positive number");
  }
}

void check_options(const LoadOptions& options) {
  check_positive("relief", options.relief);
  check_positive("relief_share", options.relief_share);
  if (options.relief && options.relief_share)
    throw UsageError("the relief is given twice: as a height, and as a share of the width");
  check_positive("width", options.width);
  if (!options.texel) return;
  check_positive("texel", options.texel->x);
  check_positive("texel", options.texel->y);
  if (options.width) throw UsageError("width", "", "excludes a texel, since both give the spacing");
}

StoredHeights read_grid(const std::filesystem::path& path, const LoadOptions& options,
                        std::uint64_t memory_limit) {
  StoredHeights stored;
  EsriGrid grid = read_esri_grid(path, memory_limit);
  if (options.channel) find_channel(path, {"height"}, *options.channel);
  stored.facts.channel = "height";
  stored.facts.channels = 1;
  stored.facts.sample_type = "text";
  stored.facts.declared_no_data = grid.header.no_data;
  stored.values = std::move(grid.values);
  stored.grid = grid.header;
  return stored;
}

StoredHeights read_picture(const std::filesystem::path& path, FileFormat format, const LoadOptions& options,
                           std::uint64_t memory_limit) {
  const StoredImage image = read_image(path, format, memory_limit);
  StoredHeights stored;
  ChannelSamples channel = pick_channel(path, image, options.channel);
  stored.values = std::move(channel.values);
  stored.facts.channel = channel.name;
  stored.facts.channels = static_cast<int>(image.channels.size());
  stored.facts.sample_type = image.sample_type;
  stored.facts.bits = image.bits;
  stored.facts.is_integer = image.is_integer;
  stored.facts.declared_no_data = image.no_data;
  return stored;
}

/// A no-data value given in decimals stands for the nearest value that the samples can take.
double as_stored(double value, const std::string& sample_type) {
  if (sample_type != "float" || std::abs(value) > std::numeric_limits<float>::max()) return value;
  return static_cast<double>(static_cast<float>(value));
}

/// Makes NaN of what is missing, and notes range and levels of the rest. Throws Error where nothing is left.
void drop_missing(const std::filesystem::path& path, const std::optional<double>& no_data,
                  StoredHeights& stored) {
  const std::string& type = stored.facts.sample_type;
  const double given = as_stored(no_data.value_or(kMissing), type);
  const double declared = as_stored(stored.facts.declared_no_data.value_or(kMissing), type);
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (double& value : stored.values.values) {
    if (!std::isfinite(value) || value == given || value == declared) {
      value = kMissing;
    } else {
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
  }
  if (lowest > highest) throw file_error(path, "all its samples are missing (no-data)");
  stored.facts.lowest = lowest;
  stored.facts.highest = highest;
  stored.facts.levels = count_levels(stored.values);
}

Spacing choose_spacing(const std::filesystem::path& path, const LoadOptions& options,
                       const StoredHeights& stored) {
  if (options.texel) return *options.texel;
  const double columns = stored.values.width;
  Spacing cell{1 / columns, 1 / columns};
  if (stored.grid) {
    cell = {stored.grid->cell_x, stored.grid->cell_y};
    if (is_in_degrees(*stored.grid, stored.facts.highest - stored.facts.lowest)) {
      const Spacing metres = cell_in_metres(*stored.grid);
      const std::string texel = fmt::format("{:.4g}x{:.4g}", metres.x, metres.y);
      throw file_error(path,
                       "its cell size is in degrees; give the spacing in metres, which is " + texel +
                           " at its middle latitude",
                       "texel " + texel);
    }
  }
  if (options.width) cell = {*options.width / columns, *options.width / columns * (cell.y / cell.x)};
  return cell;
}

/// Heights above the lowest sample, scaled so that they span `relief` where that is given.
Image<float> to_heights(const std::filesystem::path& path, const StoredHeights& stored,
                        const std::optional<double>& relief, bool invert) {
  const double span = stored.facts.highest - stored.facts.lowest;
  const double scale = relief && span > 0 ? *relief / span : 1;
  if (!(span * scale <= static_cast<double>(std::numeric_limits<float>::max()))) {
    throw file_error(path, "its heights span more than single precision can hold");
  }
  Image<float> heights(stored.values.width, stored.values.height);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double value = stored.values.values[i];
    const double above = invert ? stored.facts.highest - value : value - stored.facts.lowest;
    heights.values[i] = static_cast<float>(above * scale);
  }
  return heights;
}

}  // namespace

LoadedHeightmap load_heightmap(const std::filesystem::path& path, const LoadOptions& options,
                               std::uint64_t memory_limit) {
  check_options(options);
  const FileFormat format = recognise_format(path);
  StoredHeights stored = format == FileFormat::esri_grid ? read_grid(path, options, memory_limit)
                                                         : read_picture(path, format, options, memory_limit);
  drop_missing(path, options.no_data, stored);

  LoadedHeightmap loaded;
  Heightmap& map = loaded.map;
  map.spacing = choose_spacing(path, options, stored);
  map.boundary = options.boundary.value_or(stored.grid ? Boundary::open : Boundary::tile);
  std::optional<double> relief = options.relief;
  const double width = map.spacing.x * stored.values.width;
  if (options.relief_share) relief = *options.relief_share * width;
  if (!relief && stored.facts.is_integer) relief = width / 10;
  map.height = to_heights(path, stored, relief, options.invert);
  if (!relief) map.base = options.invert ? -stored.facts.highest : stored.facts.lowest;
  if (options.shrink != 1) map = shrink(map, options.shrink);

  loaded.facts = std::move(stored.facts);
  loaded.facts.format = to_string(format);
  loaded.facts.sha256 = sha256_of_file(path);
  return loaded;
}

}  // namespace heightlight
