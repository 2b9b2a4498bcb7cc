#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/degrees.h"
#include "files/doubts.h"
#include "files/geo_keys.h"
#include "files/geotiff_place.h"
#include "files/ground_spacing.h"
#include "files/image_file.h"
#include "files/load_by_rows.h"
#include "files/no_data.h"
#include "files/stored_heights.h"
#include "files/suspects.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

/// Lengths outside these limits are typing errors, and their squares exceed single precision.
constexpr double kShortest = 1e-12;
constexpr double kLongest = 1e12;

void check_length(const char* quantity, const std::optional<double>& value) {
  if (!value) return;
  if (!(*value > 0 && std::isfinite(*value))) throw UsageError(quantity, "", "must be a positive number");
  if (*value < kShortest || *value > kLongest)
    throw UsageError(quantity, fmt::format("{:g}", *value), "must be from 1e-12 to 1e12");
}

/// Uses the heights to decide whether cells are in degrees, where the file does not say.
void judge_place(StoredHeights& stored) {
  if (!stored.place || stored.place->in_degrees || stored.place->metres) return;
  const double span = stored.facts.highest - stored.facts.lowest;
  stored.place->in_degrees =
      looks_like_degrees(*stored.place, stored.values.width, stored.values.height, span);
}

/// Results made from the map get the no-data value of its file, or the one with which it was read, limited to
/// single precision, the precision of results. A tag that is not a number is removed, because programs would
/// read it as 0.
void note_no_data(const std::optional<double>& no_data, Georeference& place) {
  const GeoTag* tag = find_tag(place.tags, kGdalNoDataTag);
  const std::optional<double> told = tag ? parse_no_data(text_of(*tag)) : std::nullopt;
  const std::optional<double> value = told ? told : no_data;
  constexpr double kLargest = std::numeric_limits<float>::max();
  const bool is_beyond = value && std::isfinite(*value) && std::fabs(*value) > kLargest;
  if (told && !is_beyond) return;
  std::erase_if(place.tags, [](const GeoTag& other) { return other.number == kGdalNoDataTag; });
  if (!value) return;
  place.tags.push_back(
      make_tag(kGdalNoDataTag, fmt::format("{:.17g}", is_beyond ? std::copysign(kLargest, *value) : *value)));
}

/// A georeference that cannot be used is left out if the spacing is given; otherwise it is an error.
void check_place(const InputFile& file, const LoadOptions& options, StoredHeights& stored) {
  if (stored.place_fault.empty()) return;
  if (!options.texel) throw file.error(stored.place_fault + "; or give the spacing", "texel");
  stored.warnings.push_back({stored.place_fault + ": its place was left out"});
}

Spacing choose_spacing(const InputFile& file, const LoadOptions& options, StoredHeights& stored) {
  if (options.texel) return *options.texel;
  if (options.degrees_in_metres && !(stored.place && stored.place->in_degrees) && !options.width)
    throw file.error("does not tell a spacing in degrees, which texel auto would turn into metres", "texel");
  const double columns = stored.values.width;
  Spacing cell{1 / columns, 1 / columns};
  if (stored.place) cell = spacing_on_ground(file, *stored.place, stored.values.height, stored.warnings);
  if (options.width) cell = {*options.width / columns, *options.width / columns * (cell.y / cell.x)};
  return cell;
}

/// Converts the memory of work on the shrunk map to a function of the file's columns and rows.
WorkBytes after_shrinking(const WorkBytes& work, int factor) {
  if (!work || factor == 1) return work;
  return [&work, factor](int columns, int rows) {
    return work((columns + factor - 1) / factor, (rows + factor - 1) / factor);
  };
}

/// Converts stored values to heights above the lowest one.
struct HeightRule {
  double scale = 1;  ///< height per stored value
  bool invert = false;
  double lowest = 0;  ///< in stored values
  double highest = 0;
  bool is_stretched = false;  ///< to a relief that the file does not give

  float operator()(double value) const {
    return static_cast<float>((invert ? highest - value : value - lowest) * scale);
  }
  double relief() const { return (highest - lowest) * scale; }
};

/// Makes the rule; `map` must already have its spacing.
HeightRule height_rule(const InputFile& file, const LoadOptions& options, const StoredHeights& stored,
                       const Heightmap& map) {
  std::optional<double> relief = options.relief;
  const double width = map.spacing.x * stored.values.width;
  if (options.relief_share) relief = *options.relief_share * width;
  if (!relief && stored.facts.is_stretched) relief = width / 10;
  const double span = stored.facts.highest - stored.facts.lowest;
  const HeightRule rule{.scale = relief && span > 0 ? *relief / span : options.scale.value_or(stored.scale),
                        .invert = options.invert != stored.facts.white_is_zero,
                        .lowest = stored.facts.lowest,
                        .highest = stored.facts.highest,
                        .is_stretched = relief.has_value()};
  if (!(rule.relief() <= static_cast<double>(std::numeric_limits<float>::max())))
    throw file.error("its heights span more than single precision can hold");
  return rule;
}

/// World height of the lowest height.
double base_of(const HeightRule& rule, const LoadOptions& options, const StoredHeights& stored) {
  if (rule.is_stretched) return 0;
  return (rule.invert ? -rule.highest : rule.lowest) * rule.scale + options.offset.value_or(stored.offset);
}

Image<float> to_heights(const Image<double>& values, const HeightRule& rule) {
  Image<float> heights(values.width, values.height);
  for (std::size_t i = 0; i < heights.size(); ++i) heights.values[i] = rule(values.values[i]);
  return heights;
}

/// Steeper slopes overflow single precision when squared. `suspects` may explain them.
void check_slopes(const InputFile& file, double relief, const Spacing& spacing,
                  const std::vector<Warning>& suspects) {
  constexpr double kSteepest = 1e12;
  if (relief <= kSteepest * std::min(spacing.x, spacing.y)) return;
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
                               std::uint64_t memory_limit, const WorkBytes& work) {
  check_load_options(options);
  const InputFile file(path);
  StoredHeights stored =
      read_stored_heights(file, options, {memory_limit, after_shrinking(work, options.shrink)});

  LoadedHeightmap loaded;
  Heightmap& map = loaded.map;
  check_place(file, options, stored);
  judge_place(stored);
  map.spacing = choose_spacing(file, options, stored);
  map.boundary = options.boundary.value_or(stored.place ? Boundary::open : Boundary::tile);
  stored.facts.is_relief_guessed = stored.facts.is_stretched && !options.relief && !options.relief_share;
  const HeightRule rule = height_rule(file, options, stored, map);
  map.height = to_heights(stored.values, rule);
  loaded.warnings = find_suspects(stored);
  check_slopes(file, relief(map), map.spacing, loaded.warnings);
  map.base = base_of(rule, options, stored);
  if (options.shrink != 1) map = shrink(map, options.shrink);
  if (stored.place) {
    loaded.place = shrink_place(*stored.place, options.shrink);
    note_no_data(options.no_data ? options.no_data : stored.facts.declared_no_data, *loaded.place);
  }

  for (const std::vector<Warning>& more : {find_doubts(map, stored, options), stored.warnings})
    loaded.warnings.insert(loaded.warnings.end(), more.begin(), more.end());
  if (options.curvature) map = curve_heights(std::move(map), *options.curvature);
  loaded.facts = std::move(stored.facts);
  loaded.facts.sha256 = sha256_of_file(file);
  file.check_unchanged();
  return loaded;
}

namespace {

/// The lowest height after subtraction of the Earth's curvature.
double lowest_when_curved(StoredHeightRows& rows, const HeightRule& rule, const Heightmap& map) {
  double lowest = std::numeric_limits<double>::infinity();
  rows.for_rows([&](int first, const Image<double>& values) {
    for (int row = 0; row < values.height; ++row) {
      for (int column = 0; column < values.width; ++column) {
        const double height = double{rule(values(row, column))} - curvature_drop(map, first + row, column);
        if (height < lowest) lowest = height;
      }
    }
  });
  return lowest;
}

}  // namespace

LoadedHeightmap load_heightmap_by_rows(const std::filesystem::path& path, const LoadOptions& options,
                                       const TakeRows& take) {
  check_load_options(options);
  if (options.shrink != 1) throw UsageError("shrink", "", "is not for maps that are read in parts");
  const InputFile file(path);
  StoredHeightRows rows(file, options);
  StoredHeights& stored = rows.stored();
  LoadedHeightmap loaded;
  Heightmap& map = loaded.map;
  check_place(file, options, stored);
  judge_place(stored);
  map.spacing = choose_spacing(file, options, stored);
  map.boundary = options.boundary.value_or(stored.place ? Boundary::open : Boundary::tile);
  map.height.width = stored.values.width;
  map.height.height = stored.values.height;
  stored.facts.is_relief_guessed = stored.facts.is_stretched && !options.relief && !options.relief_share;
  const HeightRule rule = height_rule(file, options, stored, map);
  check_slopes(file, rule.relief(), map.spacing, {});
  map.base = base_of(rule, options, stored);
  double lowest = 0;
  if (options.curvature) {
    begin_curving(map, *options.curvature);
    lowest = lowest_when_curved(rows, rule, map);
    map.base += lowest;
  }
  rows.for_rows([&](int first, const Image<double>& values) {
    Map heights = to_heights(values, rule);
    for (int row = 0; options.curvature && row < heights.height; ++row) {
      for (int column = 0; column < heights.width; ++column) {
        float& height = heights(row, column);
        height = static_cast<float>(double{height} - curvature_drop(map, first + row, column) - lowest);
      }
    }
    take(map, first, heights);
  });
  if (stored.place) {
    loaded.place = stored.place;
    note_no_data(options.no_data ? options.no_data : stored.facts.declared_no_data, *loaded.place);
  }
  loaded.warnings = stored.warnings;
  loaded.facts = std::move(stored.facts);
  loaded.facts.sha256 = sha256_of_file(file);
  file.check_unchanged();
  return loaded;
}

}  // namespace heightlight
