#include "files/stored_heights.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "files/channel.h"
#include "files/esri_grid.h"
#include "files/geo_keys.h"
#include "files/image_read.h"
#include "files/interrupt.h"
#include "files/level_count.h"
#include "files/named.h"
#include "files/no_data.h"
#include "files/projection_text.h"
#include "files/sample_grid.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

Georeference place_of(const InputFile& file, const EsriHeader& header) {
  Georeference place{.cell = {header.cell_x, header.cell_y}};
  if (header.west && header.south)
    place.corner = {{*header.west, *header.south + header.rows * header.cell_y}};
  note_projection(read_projection_text(file.path()), place);
  place.tags = make_geo_tags(place);
  return place;
}

StoredHeights read_grid(const InputFile& file, const LoadOptions& options, const ReadLimit& limit) {
  if (options.part) throw UsageError(file.path().string() + ": has no parts; only EXR files have");
  StoredHeights stored;
  EsriGrid grid = read_esri_grid(file, limit);
  if (options.channel) find_named("channel", file, {"height"}, *options.channel);
  stored.facts.channel = "height";
  stored.facts.channels = 1;
  stored.facts.sample_type = "text";
  stored.facts.declared_no_data = grid.header.no_data;
  stored.values = std::move(grid.values);
  stored.place = place_of(file, grid.header);
  return stored;
}

/// Reads a file of samples stored one after the other, which is neither a picture nor text.
StoredHeights read_sample_file(const InputFile& file, FileFormat format, const LoadOptions& options,
                               const ReadLimit& limit) {
  if (options.part) throw UsageError(file.path().string() + ": has no parts; only EXR files have");
  if (options.channel) find_named("channel", file, {"height"}, *options.channel);
  if (format == FileFormat::raw && !options.size) throw raw_needs_size(file);
  SampleGrid grid =
      format == FileFormat::numpy ? read_numpy(file, limit)
      : format == FileFormat::srtm
          ? read_srtm(file, limit)
          : read_raw(
                file,
                {.width = (*options.size)[0], .height = (*options.size)[1], .big_endian = options.big_endian},
                limit);
  StoredHeights stored;
  stored.facts.channel = "height";
  stored.facts.channels = 1;
  stored.facts.sample_type = grid.sample_type;
  stored.facts.bits = grid.bits;
  stored.facts.is_integer = grid.is_integer;
  const bool is_signed = grid.sample_type.starts_with("int") && grid.bits >= 16;
  const bool is_elevation = format == FileFormat::srtm || (options.texel && is_signed);
  stored.facts.is_stretched = grid.is_integer && !is_elevation;
  stored.values = std::move(grid.values);
  stored.place = grid.place;
  constexpr double kSrtmVoid = -32768;
  if (format == FileFormat::srtm) stored.facts.declared_no_data = kSrtmVoid;
  return stored;
}

/// Whether integer samples are elevations in metres, as in a digital elevation model; others have no unit and
/// are stretched to a relief.
bool is_elevation(const StoredImage& image, const LoadOptions& options) {
  if (!image.tiff) return false;
  const bool is_signed = image.sample_type.starts_with("int");
  return image.tiff->place.place || (options.texel && image.bits >= 16 && (is_signed || image.tiff->no_data));
}

void take_no_data_tag(StoredHeights& stored) {
  const std::optional<std::string>& text = stored.tiff->no_data;
  if (!text || text->empty()) return;
  stored.facts.declared_no_data = parse_no_data(*text);
  if (stored.facts.declared_no_data) return;
  stored.warnings.push_back({"its no-data tag says '" + text->substr(0, 32) +
                             "', which is no number; no sample was taken for missing by it"});
}

/// Takes scale and offset from GDAL's metadata, and warns of a mask of missing samples.
void take_metadata(const InputFile& file, const LoadOptions& options, StoredHeights& stored) {
  const TiffFacts& tiff = *stored.tiff;
  if (tiff.has_mask)
    stored.warnings.push_back(
        {"it has a mask of missing samples, which is not read; give their value", "no_data"});
  const double scale = tiff.scale.value_or(1);
  const double offset = tiff.offset.value_or(0);
  if (options.scale || options.offset || (scale == 1 && offset == 0)) return;
  if (!(scale > 0) || !std::isfinite(scale) || !std::isfinite(offset))
    throw file.error(
        fmt::format("says that heights are {:g} times its samples, plus {:g}; give a positive scale", scale,
                    offset),
        "scale");
  stored.scale = scale;
  stored.offset = offset;
  stored.facts.is_stretched = false;
  stored.warnings.push_back(
      {fmt::format("heights are {:g} times its samples, plus {:g}, as it says", scale, offset)});
}

/// Everything about an image's heights except the samples and the name of their channel.
StoredHeights describe_heights(const InputFile& file, const StoredImage& image, const LoadOptions& options) {
  StoredHeights stored;
  for (const std::string& warning : image.warnings) stored.warnings.push_back({warning});
  stored.facts.channels = static_cast<int>(image.channels.size());
  stored.facts.sample_type = image.sample_type;
  stored.facts.bits = image.bits;
  stored.facts.is_integer = image.is_integer;
  stored.facts.is_stretched = image.is_integer && !is_elevation(image, options);
  stored.tiff = image.tiff;
  if (!image.tiff) return stored;
  stored.place = image.tiff->place.place;
  stored.place_fault = image.tiff->place.fault;
  take_no_data_tag(stored);
  take_metadata(file, options, stored);
  stored.facts.white_is_zero = image.is_integer && image.tiff->white_is_zero;
  return stored;
}

StoredHeights read_picture(const InputFile& file, FileFormat format, const LoadOptions& options,
                           const ReadLimit& limit) {
  const StoredImage image = read_image(file, format, limit, options.part);
  ChannelSamples channel = pick_channel(file, image, options.channel);
  StoredHeights stored = describe_heights(file, image, options);
  const auto after_own = stored.warnings.begin() + static_cast<std::ptrdiff_t>(image.warnings.size());
  std::vector<Warning> of_channel;
  for (const std::string& warning : channel.warnings) of_channel.push_back({warning});
  stored.warnings.insert(after_own, of_channel.begin(), of_channel.end());
  stored.values = std::move(channel.values);
  stored.facts.channel = channel.name;
  return stored;
}

/// Esri's software treats -9999 as missing if a grid's header names no other value.
void assume_esri_default(StoredHeights& stored) {
  constexpr double kEsriDefault = -9999;
  if (stored.facts.format != to_string(FileFormat::esri_grid) || stored.facts.declared_no_data) return;
  const std::size_t dropped = drop_no_data(kEsriDefault, stored.facts.sample_type, stored.values);
  if (dropped == 0) return;
  stored.facts.declared_no_data = kEsriDefault;
  stored.facts.no_data_assumed = true;
  stored.warnings.push_back(
      {std::to_string(dropped) +
       " samples are -9999, which means missing where the header names no other value"});
}

/// Replaces samples that are not finite by NaN, and widens the range by the others.
void note_range(Image<double>& values, SourceFacts& facts) {
  for (double& value : values.values) {
    if (!std::isfinite(value)) {
      value = std::numeric_limits<double>::quiet_NaN();
    } else {
      facts.lowest = std::min(facts.lowest, value);
      facts.highest = std::max(facts.highest, value);
    }
  }
}

void drop_named(const std::optional<double>& no_data, const SourceFacts& facts, Image<double>& values) {
  for (const std::optional<double>& value : {no_data, facts.declared_no_data}) {
    if (value) drop_no_data(*value, facts.sample_type, values);
  }
}

void empty_range(SourceFacts& facts) {
  facts.lowest = std::numeric_limits<double>::infinity();
  facts.highest = -facts.lowest;
}

/// Replaces missing samples by NaN, and notes the range and the levels of the others.
void drop_missing(const InputFile& file, const std::optional<double>& no_data, StoredHeights& stored) {
  SourceFacts& facts = stored.facts;
  drop_named(no_data, facts, stored.values);
  assume_esri_default(stored);
  empty_range(facts);
  note_range(stored.values, facts);
  if (facts.lowest > facts.highest) throw file.error("all its samples are missing (no-data)");
  const Levels levels = count_levels(stored.values);
  facts.levels = levels.count;
  facts.level_step = levels.step;
}

}  // namespace

StoredHeights read_stored_heights(const InputFile& file, const LoadOptions& options, const ReadLimit& limit) {
  const FileFormat format = recognise_format(file);
  if (options.size && format != FileFormat::raw)
    throw UsageError(file.path().string() + ": tells its size itself; only raw samples want one");
  StoredHeights stored = format == FileFormat::esri_grid ? read_grid(file, options, limit)
                         : is_picture(format)            ? read_picture(file, format, options, limit)
                                                         : read_sample_file(file, format, options, limit);
  stored.facts.format = to_string(format);
  if (options.scale || options.offset) stored.facts.is_stretched = false;
  drop_missing(file, options.no_data, stored);
  return stored;
}

StoredHeightRows::StoredHeightRows(const InputFile& file, const LoadOptions& options)
    : file_(file), options_(options), rows_(file), stored_(describe_heights(file, rows_.header(), options)) {
  const std::vector<std::string>& channels = rows_.header().channels;
  if (options.part) throw UsageError(file.path().string() + ": has no parts; only EXR files have");
  if (!options.channel && channels.size() > 1)
    throw file.error("has " + std::to_string(channels.size()) + " channels: " + join_names(channels) +
                         "; read in parts, it wants one to be chosen",
                     "channel");
  stored_.facts.format = to_string(FileFormat::tiff);
  stored_.facts.channel =
      channels[options.channel ? find_named("channel", file, channels, *options.channel) : 0];
  if (options.scale || options.offset) stored_.facts.is_stretched = false;
  stored_.values.width = rows_.header().width;
  stored_.values.height = rows_.header().height;
  empty_range(stored_.facts);
  for_rows([this](int, Image<double>& values) { note_range(values, stored_.facts); });
  if (stored_.facts.lowest > stored_.facts.highest) throw file.error("all its samples are missing (no-data)");
}

void StoredHeightRows::for_rows(const std::function<void(int, Image<double>&)>& visit) {
  constexpr int kAtOnce = 256;
  const int together = rows_.together();
  const int count = (kAtOnce + together - 1) / together * together;
  for (int first = 0; first < stored_.values.height; first += count) {
    throw_if_interrupted();
    const StoredImage part = rows_.read(first, std::min(count, stored_.values.height - first));
    ChannelSamples channel = pick_channel(file_, part, options_.channel);
    drop_named(options_.no_data, stored_.facts, channel.values);
    for (double& value : channel.values.values) {
      if (!std::isfinite(value)) value = std::numeric_limits<double>::quiet_NaN();
    }
    visit(first, channel.values);
  }
}

}  // namespace heightlight
