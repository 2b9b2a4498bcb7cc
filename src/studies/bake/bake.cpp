#include "bake/bake.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bake/baked_map.h"
#include "bake/blue_noise.h"
#include "bake/file_name.h"
#include "bake/former_bake.h"
#include "bake/packed_texture.h"
#include "bake/sidecar.h"
#include "bake/texel_encoding.h"
#include "bake/texture_files.h"
#include "base/digits.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "files/esri_grid_write.h"
#include "files/image_file.h"
#include "files/output_file.h"
#include "files/specular_table_file.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/shaders.h"
#include "visibility/reach_table.h"

namespace heightlight {
namespace {

const char* extension_of(TextureFormat format) {
  switch (format) {
    case TextureFormat::png:
      return ".png";
    case TextureFormat::exr:
      return ".exr";
    case TextureFormat::tif:
      return ".tif";
    case TextureFormat::asc:
      break;
  }
  return ".asc";
}

SampleType sample_type(TextureDepth depth) {
  switch (depth) {
    case TextureDepth::uint8:
      return SampleType::uint8;
    case TextureDepth::uint16:
      return SampleType::uint16;
    case TextureDepth::half:
      return SampleType::half;
    case TextureDepth::real:
      break;
  }
  return SampleType::real;
}

std::vector<std::string> channel_names(const BakedTexture& texture) {
  static const std::vector<std::string> kColour{"R", "G", "B", "A"};
  const std::size_t count = texture.channels.size();
  if (count == 1) return {"Y"};
  if (count <= 4) return {kColour.begin(), kColour.begin() + static_cast<std::ptrdiff_t>(count)};
  std::vector<std::string> names;
  const std::size_t digits = count <= 100 ? 100 : 1000;
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(std::to_string(digits + i));
    names.back().front() = 'c';  // in place: g++ 12 warns falsely of "c" + a string that ends here
  }
  return names;
}

/// What a GeoTIFF says of its bands.
std::vector<BandText> band_texts(const BakedTexture& texture) {
  std::vector<BandText> bands;
  for (const BakedChannel& channel : texture.channels)
    bands.push_back({.description = channel.quantity, .unit = channel.unit == "1" ? "" : channel.unit});
  return bands;
}

/// The values of a texture that a material has.
FillRows values_of(const BakedTexture& texture, int width) {
  return [&texture, width](int first, int rows, float* samples) {
    const std::size_t count = texture.channels.size();
    parallel_for(rows, [&](std::int64_t line) {
      const auto texels = static_cast<std::size_t>(width);
      float* out = samples + static_cast<std::size_t>(line) * texels * count;
      const std::size_t begin = static_cast<std::size_t>(first + line) * texels;
      for (std::size_t i = begin; i < begin + texels; ++i) {
        for (const BakedChannel& channel : texture.channels) *out++ = channel.value(i);
      }
    });
  };
}

/// A map's samples as its file holds them. All arguments must outlive them.
FillRows encoded_rows(const BakedTexture& texture, const FillRows& values, int width,
                      const TexelEncoding& encoding) {
  return [&texture, &values, width, &encoding](int first, int rows, float* samples) {
    values(first, rows, samples);
    const auto count = static_cast<int>(texture.channels.size());
    parallel_for(rows, [&](std::int64_t line) {
      const int row = first + static_cast<int>(line);
      float* sample = samples + line * width * count;
      for (int column = 0; column < width; ++column) {
        for (int c = 0; c < count; ++c, ++sample)
          *sample =
              encode_texel(encoding, texture.channels[static_cast<std::size_t>(c)], *sample, row, column, c);
      }
    });
  };
}

void write_baked(const std::filesystem::path& path, const BakedTexture& texture, const FillRows& values,
                 const TexelEncoding& encoding, const BakedMap& map) {
  const TextureLayout layout{.width = map.header.height.width,
                             .height = map.header.height.height,
                             .channels = channel_names(texture),
                             .type = sample_type(encoding.depth),
                             .attributes = {{"ImageDescription", texture.definition}},
                             .place = map.place ? &*map.place : nullptr,
                             .bands = band_texts(texture)};
  const FillRows rows = encoded_rows(texture, values, layout.width, encoding);
  if (path.extension() == ".asc") return write_esri_grid(path, layout, map.header.spacing, rows);
  write_texture(path, layout, rows);
}

/// What the user should know before believing the maps, of the file and of what was made of it.
std::vector<Warning> find_warnings(std::vector<Warning> warnings, const Heightmap& map,
                                   const Evidence& evidence, const BakeOptions& options) {
  for (const std::string& fault : find_faults(evidence)) warnings.push_back({fault});
  if (options.dither && map.boundary == Boundary::tile &&
      (map.height.width % kDitherSide != 0 || map.height.height % kDitherSide != 0)) {
    warnings.push_back(
        {"the dither repeats every 64 texels, which does not divide the map: its pattern has a seam"});
  }
  return warnings;
}

/// Writes the functions that read `ao-n`, beside it.
void write_shaders(StagedFolder& folder) {
  write_bytes(folder.file("ao-n.glsl"), stored_pair_shader(ShaderLanguage::glsl));
  write_bytes(folder.file("ao-n.hlsl"), stored_pair_shader(ShaderLanguage::hlsl));
}

/// Files beside `specular-occlusion`: functions that find it from other maps, and the table that one reads.
constexpr int kTableSide = 16;
constexpr std::array kGlossFiles{"specular-occlusion.glsl", "specular-occlusion.hlsl", "gtso.ktx"};

void write_gloss_files(StagedFolder& folder, const BakeOptions& options) {
  const SpecularTable table = make_specular_table(kTableSide, options.watch);
  const bool are_baked = is_wanted(options, MaterialMap::horizon) && options.horizon_azimuths >= 3;
  const int horizons = are_baked ? options.horizon_azimuths : kShaderHorizons;
  write_bytes(folder.file(kGlossFiles[0]), gloss_shader(ShaderLanguage::glsl, horizons));
  write_bytes(folder.file(kGlossFiles[1]), gloss_shader(ShaderLanguage::hlsl, horizons));
  write_specular_table(folder.file(kGlossFiles[2]), table);
}

/// The name of a file, or its beginning, of a map of that stem.
std::string fill_name(const std::string& text, const std::string& stem, const std::string& map) {
  return fill_placeholders("name", text, {{"stem", stem}, {"material", material_name(stem)}, {"map", map}});
}

std::vector<std::string> checked_files(const std::string& name, const BakeOptions& options) {
  check_file_names(name, options);
  return baked_files(name, options);
}

std::string report_file(const std::string& name) { return name + "_report.html"; }

std::string sheet_file(const std::string& name) { return name + "_sheet.png"; }

/// A folder that is ready to take a bake. All arguments must outlive it.
class StagedBake {
 public:
  StagedBake(const BakeOptions& options, const BakeTarget& target)
      : options_(options),
        target_(target),
        files_(checked_files(target.name, options)),
        former_(find_former_maps(target.folder / files_.back(), options.surface, files_)),
        folder_(target.folder, target.inputs, files_, former_record()) {}

  BakeOutcome write(const BakedMap& map, const std::vector<BakedTexture>& textures,
                    const TextureValues& values) {
    Stopwatch watch;
    const Evidence& evidence = map.material.results.evidence;
    SidecarFacts told{.source = target_.source,
                      .map = map,
                      .former = std::move(former_),
                      .warnings = find_warnings(map.warnings, map.header, evidence, options_)};
    write_textures(textures, values, map);
    if (options_.draw_sheet) {
      const std::string sheet = sheet_file(target_.name);
      write_png(folder_.file(sheet), options_.draw_sheet(map.material, options_.albedo));
    }
    told.files = folder_.written();  // the shaders that follow are those of every map in the folder
    if (is_wanted(options_, MaterialMap::ao_n)) write_shaders(folder_);
    if (is_wanted(options_, MaterialMap::specular_occlusion)) write_gloss_files(folder_, options_);
    told.output_seconds = watch.lap();
    if (options_.write_report) {
      options_.write_report(folder_.file(report_file(target_.name)), {.map = map,
                                                                      .textures = textures,
                                                                      .values = values,
                                                                      .options = options_,
                                                                      .target = target_,
                                                                      .files = files_,
                                                                      .warnings = told.warnings,
                                                                      .output_seconds = told.output_seconds});
      told.report = folder_.written().back();
    }
    write_sidecar(folder_.file(files_.back()), options_, textures, told);
    return {.warnings = std::move(told.warnings), .removed = folder_.commit()};
  }

  BakeOutcome write(const Material& material, const HeightSource& source, std::vector<Warning> warnings) {
    const Heightmap& map = material.surface->map;
    const BakedMap baked{.material = material,
                         .header = map,
                         .relief = relief(map),
                         .missing = count_missing(map),
                         .sha256 = source.facts.sha256,
                         .place = source.place,
                         .warnings = std::move(warnings)};
    const std::vector<BakedTexture> textures = baked_textures(material, options_);
    return write(baked, textures,
                 [&](std::size_t texture) { return values_of(textures[texture], map.height.width); });
  }

 private:
  FormerRecord former_record() const {
    if (!former_.empty()) return {};  // of the same heights
    const std::string before_map = options_.name.substr(0, options_.name.find("{map}"));
    return {.file = files_.back(), .prefix = fill_name(before_map, target_.name, "")};
  }

  /// Compression takes longest, and the libraries compress a file on one thread.
  void write_textures(const std::vector<BakedTexture>& textures, const TextureValues& values,
                      const BakedMap& map) {
    const TexelEncoding encoding = make_encoding(options_);
    std::vector<std::filesystem::path> paths;
    for (std::size_t i = 0; i < textures.size(); ++i) paths.push_back(folder_.file(files_[i]));
    parallel_for(static_cast<std::int64_t>(textures.size()), [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      write_baked(paths[at], textures[at], values(at), encoding, map);
    });
    for (const std::string& file : files_) {
      if (file.ends_with(".prj")) write_bytes(folder_.file(file), options_.projection);
    }
  }

  const BakeOptions& options_;
  const BakeTarget& target_;
  std::vector<std::string> files_;
  nlohmann::ordered_json former_;
  StagedFolder folder_;
};

std::vector<MaterialMapName> with_definitions(std::vector<MaterialMapName> maps) {
  for (const SkyDefinitionFacts& facts : sky_definitions())
    maps.push_back({static_cast<MaterialMap>(maps.size()), facts.name, facts.formula});
  return maps;
}

/// A relief that was guessed is too much where hardly any sky is seen, unless its slopes say so already.
void doubt_darkness(const Material& material, std::vector<Warning>& warnings) {
  constexpr double kDark = 0.3;
  double sum = 0;
  double count = 0;
  for (const float sky : material.results.sky_view_factor.values) {
    if (std::isnan(sky)) continue;
    sum += double{sky};
    ++count;
  }
  const bool is_told = std::any_of(warnings.begin(), warnings.end(), [](const Warning& warning) {
    return warning.remedy.starts_with("relief");
  });
  if (count == 0 || sum > kDark * count || is_told) return;
  warnings.insert(
      warnings.begin(),
      {fmt::format("its mean ambient occlusion is {:.2f}, since nothing tells its relief, which was "
                   "taken as a tenth of the width; give its own",
                   sum / count),
       "relief"});
}

/// Of maps that a height's surroundings make.
void check_local_options(const BakeOptions& options) {
  if (!(options.normal_strength > 0) || !std::isfinite(options.normal_strength))
    throw UsageError("normal_strength", "", "must be a positive number");
  if (!(options.midlevel >= 0 && options.midlevel <= 1))
    throw UsageError("midlevel", in_digits(options.midlevel), "must be from 0 to 1");
  if (!options.detail_scale) return;
  if (!(*options.detail_scale >= 0) || !std::isfinite(*options.detail_scale))
    throw UsageError("detail_scale", "", "must be a length, or 0: the samples as they are");
  if (*options.detail_scale == 0 && is_wanted(options, MaterialMap::cavity))
    throw UsageError("detail_scale", "0", "leaves a cavity no surroundings");
}

}  // namespace

const std::vector<MaterialMapName>& material_maps() {
  static const std::vector<MaterialMapName> kMaps = with_definitions(
      {{MaterialMap::ao, "ao", "ambient occlusion, 1 = open"},
       {MaterialMap::multibounce, "multibounce",
        "irradiance of all bounces at the albedo, 1 = unoccluded: to be multiplied, once"},
       {MaterialMap::direct, "direct", "direct irradiance of --sun, --sky or --direct, before any bounce"},
       {MaterialMap::bent_normal, "bent-normal", "mean direction of the sky that is seen"},
       {MaterialMap::bent_cone, "bent-cone", "the same, with the half-angle of a cone in alpha"},
       {MaterialMap::normal, "normal", "normal of the surface"},
       {MaterialMap::ao_n, "ao-n", "two channels that give multibounce at any albedo, with a shader"},
       {MaterialMap::horizon, "horizon", "elevation of the horizon toward some azimuths"},
       {MaterialMap::sh, "sh", "order-2 spherical harmonics of cosine-weighted visibility"},
       {MaterialMap::height, "height", "heights from 0 to 1"},
       {MaterialMap::specular_occlusion, "specular-occlusion",
        "what gloss sees of the sky, at --roughness from --view, with shaders and GTSO's table"},
       {MaterialMap::curvature, "curvature", "mean curvature at --detail-scale: .5 flat, above it convex"},
       {MaterialMap::convexity, "convexity", "what of it is convex: 0 where it is not"},
       {MaterialMap::concavity, "concavity", "what of it is concave: 0 where it is not"},
       {MaterialMap::cavity, "cavity", "height above its surroundings at --detail-scale: crevices are dark"},
       {MaterialMap::displacement, "displacement", "height above --midlevel, in metres or centimetres"}});
  return kMaps;
}

std::optional<SkyDefinition> definition_of(MaterialMap map) {
  if (map < MaterialMap::svf_tilted) return std::nullopt;
  return static_cast<SkyDefinition>(static_cast<int>(map) - static_cast<int>(MaterialMap::svf_tilted));
}

const char* to_string(MaterialMap map) { return material_maps()[static_cast<std::size_t>(map)].name; }

std::vector<std::string> shared_files(const BakeOptions& options) {
  std::vector<std::string> files;
  if (is_wanted(options, MaterialMap::ao_n)) files = {"ao-n.glsl", "ao-n.hlsl"};
  if (is_wanted(options, MaterialMap::specular_occlusion))
    files.insert(files.end(), kGlossFiles.begin(), kGlossFiles.end());
  return files;
}

std::vector<std::string> baked_files(const std::string& name, const BakeOptions& options) {
  std::vector<std::string> files = texture_suffixes(options);
  const std::size_t textures = files.size();
  for (std::string& file : files) file = fill_name(options.name, name, file) + extension_of(options.format);
  for (std::size_t i = 0; options.format == TextureFormat::asc && !options.projection.empty() && i < textures;
       ++i)
    files.push_back(std::filesystem::path(files[i]).replace_extension(".prj").string());
  for (std::string& file : shared_files(options)) files.push_back(std::move(file));
  if (options.write_report) files.push_back(report_file(name));
  if (options.draw_sheet) files.push_back(sheet_file(name));
  files.push_back(name + "_bake.json");
  return files;
}

void check_file_names(const std::string& name, const BakeOptions& options) {
  std::set<std::string> names;
  for (const std::string& file : baked_files(name, options)) {
    if (file.starts_with('.') || file.find('/') != std::string::npos)
      throw UsageError("name", options.name, "files cannot be called " + file);
    if (!names.insert(file).second)
      throw UsageError("name", options.name, "two files would be called " + file);
  }
}

void check_bake_options(const BakeOptions& options) {
  const bool integer = largest_level(options.depth) > 0;
  if (options.maps.empty() && options.packed.empty()) throw UsageError("maps", "", "name at least one map");
  if (std::set<MaterialMap>(options.maps.begin(), options.maps.end()).size() != options.maps.size()) {
    throw UsageError("maps", "", "names a map twice");
  }
  if (options.format == TextureFormat::png && !integer) {
    throw UsageError("depth", "", "PNG holds 8 or 16 bits; the formats exr and tif hold floats");
  }
  if (options.format == TextureFormat::exr && integer) {
    throw UsageError("depth", "", "EXR holds half or float; the formats png and tif hold 8 and 16 bits");
  }
  if (options.format == TextureFormat::asc && options.depth != TextureDepth::real) {
    throw UsageError("depth", "",
                     "of an Esri grid is that of its numbers; the formats png and tif hold levels");
  }
  const bool has_cone =
      std::find(options.maps.begin(), options.maps.end(), MaterialMap::bent_cone) != options.maps.end();
  if (options.format == TextureFormat::asc && (has_cone || !options.packed.empty())) {
    throw UsageError("format", "asc", "holds one channel: bent cones and packed channels want another");
  }
  if (options.dither && options.depth != TextureDepth::uint8) {
    throw UsageError("dither", "", "only a depth of 8 bits needs it");
  }
  if (is_wanted(options, MaterialMap::direct) && options.light_channels == 0) {
    throw UsageError("maps", "",
                     "direct wants a light: a sun, a sky, or one of your own; an even sky's is ao");
  }
  if (is_wanted(options, MaterialMap::ao_n) && options.light_channels > 0) {
    throw UsageError("maps", "", "ao-n is of an even sky; bake it without a light of your own");
  }
  if (options.reach) check_reach(*options.reach);
  if (!(options.error > 0) || options.error > 1) {
    throw UsageError("error", std::to_string(options.error), "must be above 0, and 1 at most");
  }
  if (options.azimuths != 0) check_azimuths(options.azimuths);
  if (options.horizon_azimuths < 1 || options.horizon_azimuths > 360) {
    throw UsageError("horizon_azimuths", std::to_string(options.horizon_azimuths), "must be from 1 to 360");
  }
  if (options.below == BelowHorizontal::ground && is_wanted(options, MaterialMap::ao_n))
    throw UsageError("below_horizontal", "ground", "is not for ao-n, whose n is that of a sky all around");
  if (options.below == BelowHorizontal::ground && is_wanted(options, MaterialMap::specular_occlusion))
    throw UsageError("below_horizontal", "ground", "is not for specular-occlusion, whose sky is all around");
  check_gloss(options.gloss);
  check_view(options.view);
  check_packs(options);
  check_local_options(options);
}

BakeOutcome bake_material(LoadedHeightmap loaded, const BakeOptions& options, const BakeTarget& target) {
  check_bake_options(options);
  StagedBake staged(options, target);
  const Surface surface = build_surface(std::move(loaded.map));
  const Material material = find_material(surface, options);
  if (loaded.facts.is_relief_guessed) doubt_darkness(material, loaded.warnings);
  return staged.write(material, {.facts = loaded.facts, .place = loaded.place}, std::move(loaded.warnings));
}

BakeOutcome write_material(const Material& material, const HeightSource& source, const BakeOptions& options,
                           const BakeTarget& target) {
  check_bake_options(options);
  return StagedBake(options, target).write(material, source, {});
}

BakeOutcome write_textures(const BakedMap& map, const std::vector<BakedTexture>& textures,
                           const TextureValues& values, const BakeOptions& options,
                           const BakeTarget& target) {
  check_bake_options(options);
  return StagedBake(options, target).write(map, textures, values);
}

}  // namespace heightlight
