#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/degrees.h"
#include "files/doubts.h"
#include "files/image_file.h"
#include "files/stored_heights.h"
#include "files/suspects.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

/// Lengths beyond these are typing errors, and their squares leave single precision.
constexpr double kShortest = 1e-12;
constexpr double kLongest = 1e12;

void check_length(const char* quantity, const std::optional<double>& value) {
  if (!value) return;
  if (!(*value > 0 && std::isfinite(*value))) throw UsageError(quantity, "", "must be a positive number");
  if (*value < kShortest || *value > kLongest)
    throw UsageError(quantity, fmt::format("{:g}", *value), "must be from 1e-12 to 1e12");
}

/// What a file says of its samples' distances and place, of whatever kind it is.
std::optional<EsriHeader> georeference(const StoredHeights& stored) {
  if (stored.grid) return stored.grid;
  if (!stored.tiff || !stored.tiff->pixel_scale) return std::nullopt;
  EsriHeader place;
  place.columns = stored.values.width;
  place.rows = stored.values.height;
  place.cell_x = (*stored.tiff->pixel_scale)[0];
  place.cell_y = (*stored.tiff->pixel_scale)[1];
  place.west = stored.tiff->west;
  if (stored.tiff->north) place.south = *stored.tiff->north - place.rows * place.cell_y;
  return place;
}

Spacing choose_spacing(const InputFile& file, const LoadOptions& options, const StoredHeights& stored) {
  if (options.texel) return *options.texel;
  const double columns = stored.values.width;
  Spacing cell{1 / columns, 1 / columns};
  if (const std::optional<EsriHeader> place = georeference(stored)) {
    cell = {place->cell_x, place->cell_y};
    const bool said = stored.in_degrees || (stored.tiff && stored.tiff->in_degrees);
    if (said && !place->south) throw file.error("its pixel scale is in degrees; give it in metres", "texel");
    if (said || is_in_degrees(*place, stored.facts.highest - stored.facts.lowest)) {
      const Spacing metres = cell_in_metres(*place);
      if (options.degrees_in_metres) return metres;
      const std::string texel = fmt::format("{:.4g}x{:.4g}", metres.x, metres.y);
      throw file.error("its cell size is in degrees; give the spacing in metres, which is " + texel +
                           " at its middle latitude",
                       "texel " + texel);
    }
  }
  if (options.degrees_in_metres && !options.width)
    throw file.error("does not tell a spacing in degrees, which texel auto would turn into metres", "texel");
  if (options.width) cell = {*options.width / columns, *options.width / columns * (cell.y / cell.x)};
  return cell;
}

/// Heights above the lowest sample, `scale` of them to a stored value.
Image<float> to_heights(const InputFile& file, const StoredHeights& stored, double scale, bool invert) {
  const double span = stored.facts.highest - stored.facts.lowest;
  if (!(span * scale <= static_cast<double>(std::numeric_limits<float>::max())))
    throw file.error("its heights span more than single precision can hold");
  Image<float> heights(stored.values.width, stored.values.height);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const double value = stored.values.values[i];
    const double above = invert ? stored.facts.highest - value : value - stored.facts.lowest;
    heights.values[i] = static_cast<float>(above * scale);
  }
  return heights;
}

/// Beyond single precision's squares nothing can be computed; `suspects` may tell why.
void check_slopes(const InputFile& file, const Heightmap& map, const std::vector<Warning>& suspects) {
  constexpr double kSteepest = 1e12;
  if (relief(map) <= kSteepest * std::min(map.spacing.x, map.spacing.y)) return;
  if (suspects.empty()) throw file.error("its slopes exceed 1e12; is the spacing right?", "texel");
  throw file.error(suspects[0].message + "; slopes would exceed 1e12", suspects[0].remedy);
}

}  // namespace

void check_load_options(const LoadOptions& options) {
  check_length("relief", options.relief);
  check_length("relief_share", options.relief_share);
  if (options.relief && options.relief_share)
    throw UsageError("the relief is given twice: as a height, and as a share of the width");
  check_length("width", options.width);
  check_length("scale", options.scale);
  if ((options.scale || options.offset) && (options.relief || options.relief_share))
    throw UsageError(options.scale ? "scale" : "offset", "",
                     "excludes a relief, to which heights are stretched");
  if (options.offset && !std::isfinite(*options.offset)) throw UsageError("offset", "", "must be a number");
  if (options.size && ((*options.size)[0] < 1 || (*options.size)[1] < 1))
    throw UsageError("size", "", "must be columns and rows, at least 1 each");
  if (options.shrink < 1) throw UsageError("shrink", std::to_string(options.shrink), "must be 1 or more");
  if (options.no_data && !std::isfinite(*options.no_data))
    throw UsageError("no_data", "", "must be a number; NaN and infinities are missing anyway");
  if (!options.texel) return;
  check_length("texel", options.texel->x);
  check_length("texel", options.texel->y);
  if (options.width) throw UsageError("width", "", "excludes a texel, since both give the spacing");
}

LoadedHeightmap load_heightmap(const std::filesystem::path& path, const LoadOptions& options,
                               std::uint64_t memory_limit) {
  check_load_options(options);
  const InputFile file(path);
  StoredHeights stored = read_stored_heights(file, options, memory_limit);

  LoadedHeightmap loaded;
  Heightmap& map = loaded.map;
  map.spacing = choose_spacing(file, options, stored);
  map.boundary = options.boundary.value_or(georeference(stored) ? Boundary::open : Boundary::tile);
  std::optional<double> relief = options.relief;
  const double width = map.spacing.x * stored.values.width;
  if (options.relief_share) relief = *options.relief_share * width;
  if (!relief && stored.facts.is_stretched) relief = width / 10;
  const bool invert = options.invert != stored.facts.white_is_zero;
  const double span = stored.facts.highest - stored.facts.lowest;
  const double scale = relief && span > 0 ? *relief / span : options.scale.value_or(1);
  map.height = to_heights(file, stored, scale, invert);
  loaded.warnings = find_suspects(stored);
  check_slopes(file, map, loaded.warnings);
  if (!relief)
    map.base = (invert ? -stored.facts.highest : stored.facts.lowest) * scale + options.offset.value_or(0);
  if (options.shrink != 1) map = shrink(map, options.shrink);

  for (const std::vector<Warning>& more : {find_doubts(map, stored, options), stored.warnings})
    loaded.warnings.insert(loaded.warnings.end(), more.begin(), more.end());
  loaded.facts = std::move(stored.facts);
  loaded.facts.sha256 = sha256_of_file(file);
  file.check_unchanged();
  return loaded;
}

}  // namespace heightlight
