#include "cli/bake_report.h"

#include <fmt/core.h>

#include <algorithm>

#include "bake/baked_map.h"
#include "bake/material.h"
#include "cli/noted_command.h"
#include "cli/report_facts.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "report/page.h"

namespace heightlight {
namespace {

/// Channels [first, first + count) of a texture, which a picture shows together.
struct ShownChannels {
  std::size_t first = 0;
  std::size_t count = 1;
  PictureKind kind = PictureKind::light;
};

PictureKind kind_of(const BakedChannel& channel) {
  if (channel.low < 0) return PictureKind::error;
  return channel.unit == "1" ? PictureKind::light : PictureKind::plain;
}

/// Vectors and colours as one picture, all else channel by channel.
std::vector<ShownChannels> shown_channels(const BakedTexture& texture) {
  const std::vector<BakedChannel>& channels = texture.channels;
  const auto is_named = [&](std::size_t c, const char* name) { return channels[c].quantity.ends_with(name); };
  std::vector<ShownChannels> shown;
  for (std::size_t c = 0; c < channels.size();) {
    const bool has_three = c + 2 < channels.size();
    if (has_three && channels[c].quantity == "x" && channels[c + 2].quantity == "z") {
      shown.push_back({.first = c, .count = 3, .kind = PictureKind::direction});
    } else if (has_three && is_named(c, "red") && is_named(c + 2, "blue")) {
      shown.push_back({.first = c, .count = 3});
    } else {
      shown.push_back({.first = c, .kind = kind_of(channels[c])});
    }
    c += shown.back().count;
    if (channels[shown.back().first].quantity == "constant") shown.pop_back();
  }
  return shown;
}

/// Some channels of a preview of all.
Preview take_channels(const Preview& all, const ShownChannels& shown) {
  Preview taken = all;
  const auto begin = all.channels.begin() + static_cast<std::ptrdiff_t>(shown.first);
  taken.channels.assign(begin, begin + static_cast<std::ptrdiff_t>(shown.count));
  return taken;
}

void add_texture(const ReportedBake& bake, std::size_t texture, PictureGroup& group) {
  const BakedTexture& baked = bake.textures[texture];
  const Image<float>& size = bake.map.header.height;
  const Preview all =
      make_preview(size.width, size.height, static_cast<int>(baked.channels.size()), bake.values(texture));
  const std::vector<ShownChannels> parts = shown_channels(baked);
  for (const ShownChannels& part : parts) {
    PagePicture picture{.name = baked.suffix,
                        .about = baked.definition + ".",
                        .file = bake.files[texture],
                        .unit = baked.channels[part.first].unit == "1" ? "" : baked.channels[part.first].unit,
                        .kind = part.kind,
                        .channels = {},
                        .preview = take_channels(all, part)};
    if (parts.size() > 1) {
      const std::string what =
          part.kind == PictureKind::direction ? "vector" : baked.channels[part.first].quantity;
      picture.name += ": " + what.substr(0, what.find(':'));
    }
    for (std::size_t c = part.first; c < part.first + part.count; ++c)
      picture.channels.push_back(baked.channels[c].quantity);
    group.pictures.push_back(std::move(picture));
  }
}

/// How integer files keep the values: what levels stand for.
PageTable file_table(const ReportedBake& bake) {
  PageTable table{
      .title = "The files",
      .about =
          "What each channel holds. Files of integers store the range in equal steps, linear, "
          "without gamma; floats are stored as they are.",
      .columns = {{"file"}, {"channel"}, {"quantity"}, {"unit"}, {"lowest level is"}, {"highest level is"}}};
  for (std::size_t t = 0; t < bake.textures.size(); ++t) {
    for (std::size_t c = 0; c < bake.textures[t].channels.size(); ++c) {
      const BakedChannel& channel = bake.textures[t].channels[c];
      table.rows.push_back({{bake.files[t]},
                            number_cell(static_cast<double>(c + 1)),
                            {channel.quantity},
                            {channel.unit},
                            number_cell(channel.low),
                            number_cell(channel.high)});
    }
  }
  return table;
}

std::vector<PageFact> bake_asked(const ReportedBake& bake) {
  std::vector<PageFact> facts = map_facts(bake.map.header, bake.map.relief, bake.map.missing);
  append(facts, method_facts(bake.map.material.results.evidence));
  if (!bake.map.material.light.description.empty())
    facts.push_back({.name = "Light", .value = printable(bake.map.material.light.description)});
  facts.push_back({.name = "y of vectors",
                   .value = bake.options.y_down ? "down the picture (DirectX)" : "up the picture (OpenGL)"});
  if (bake.options.maximum_distance)
    facts.push_back({.name = "Occluders count up to",
                     .value = fmt::format("{:.4g} world units, but for bounces",
                                          bake.options.maximum_distance->distance)});
  return facts;
}

}  // namespace

std::uint64_t bake_report_bytes(int width, int height, const BakeOptions& options) {
  return options.write_report ? page_bytes(width, height, 2 * texture_channels(options)) : 0;
}

void write_bake_report(const std::filesystem::path& path, const ReportedBake& bake,
                       const std::vector<std::filesystem::path>& others) {
  const std::string name = printable(bake.target.source.filename());
  const Evidence& evidence = bake.map.material.results.evidence;
  const SolveTimes& seconds = evidence.seconds;
  PictureGroup group{
      .title = "Maps",
      .about =
          "All maps stand at the same place: flip between them. Values are those before they are "
          "stored in so many bits."};
  for (std::size_t t = 0; t < bake.textures.size(); ++t) add_texture(bake, t, group);
  Page page{.title = name + ": material maps",
            .what = "The maps that were baked of " + name +
                    ": what they look like, what their values are, and what they err by.",
            .asked = bake_asked(bake),
            .reached = reached_facts(evidence),
            .cost = cost_facts(seconds.visibility + seconds.transport + seconds.bounces + seconds.check +
                                   bake.output_seconds,
                               evidence.threads),
            .command = noted_command(),
            .inputs = {input_fact(bake.target.source, bake.map.sha256)},
            .warnings = warning_lines(bake.warnings),
            .groups = {std::move(group)},
            .tables = {file_table(bake)}};
  append(page.inputs, input_facts(others));
  write_bytes(path, page_html(page));
}

}  // namespace heightlight
