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
#include "bake/sidecar.h"
#include "bake/texel_encoding.h"
#include "bake/texture_files.h"
#include "bake/texture_write.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "files/output_file.h"
#include "files/specular_table_file.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/shaders.h"

namespace heightlight {
namespace {

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

}  // namespace

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
