#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "files/image_file.h"
#include "files/staged_output.h"
#include "heightlight/files.h"
#include "heightlight/gloss.h"
#include "heightlight/transport.h"
#include "heightlight/visibility.h"
#include "heightlight/watch.h"

namespace heightlight {

/// The maps that a material is made of. All vectors are in the axes of the picture: x right, z out of it, y
/// as BakeOptions::y_down says. Values at missing samples are those of an open, level place in files of
/// integers, NaN in files of floats.
enum class MaterialMap {
  ao,           ///< A (or α): share of the sky that is seen; 1 = open
  multibounce,  ///< E/π of all bounces, at the albedo, under a sky of radiance 1, or BakeOptions::find_light
  direct,       ///< E₀/π of that light, before any bounce
  bent_normal,  ///< unit, along ∫ V ω cosθ dω
  bent_cone,    ///< bent normal, with the half-angle of a cone of unoccluded directions
  normal,       ///< unit normal of the surface
  ao_n,  ///< A, and n of G(A, n, ρ) = A + ρ (1 − A) n/(1 − ρ (1 − n)), which is E/π of any albedo
  horizon,  ///< elevation of the horizon toward N azimuths
  sh,  ///< (1/π) ∫ V Y_lm cosθ dω, l ≤ 2: E/π under a sky is the dot product with its coefficients
  height,              ///< above the lowest sample, over the relief
  specular_occlusion,  ///< what a glossy lobe sees of the sky, of BakeOptions::gloss and view; 1 = open
  curvature,           ///< mean curvature of the heights' Gaussian mean, 1/world length, convex positive
  convexity,           ///< its positive part
  concavity,           ///< its negative part, positive
  cavity,              ///< height above the Gaussian mean, over its standard deviation: negative in crevices
  displacement,        ///< height above BakeOptions::midlevel, in its unit
  // As sky_definitions() has them, in that order; those made of A share the pass of `ao`.
  svf_tilted,
  svf_horizontal,
  svf_solid_angle,
  openness_positive,
  openness_negative,
  mean_cos_h,
  terrain_view_factor
};

/// The definition that a map is of, if it is of one.
std::optional<SkyDefinition> definition_of(MaterialMap map);

/// In the order above: what the command line calls it, and one line that says what it is.
struct MaterialMapName {
  MaterialMap map;
  const char* name;
  const char* description;
};
const std::vector<MaterialMapName>& material_maps();

const char* to_string(MaterialMap map);

/// Kinds of file, and how their samples are stored.
enum class TextureFormat {
  png,
  exr,
  tif,  ///< of terrain: a GeoTIFF
  asc   ///< Esri ASCII grids, one channel each
};
enum class TextureDepth { uint8, uint16, half, real };

/// A channel of a file of the user's own, of the map's size, which packs take.
struct OwnChannel {
  std::filesystem::path path = {};
  std::string channel = {};  ///< its name, or its number from 0; empty: the only one, or grey
  bool is_srgb = false;      ///< samples are decoded from sRGB; else they are linear as they stand
  Map values = {};           ///< in [0, 1]; NaN where heights are missing at most
  std::string sha256 = {};   ///< of the file as it was read
};

/// Units that engines displace surfaces in, of heights in metres.
enum class DisplacementUnit { metre, centimetre };

/// What goes into one channel of a packed texture: a component of a map, a channel of a file, or a constant.
struct PackedChannel {
  std::optional<MaterialMap> map = {};
  int component = 0;
  double constant = 0;                  ///< where there is neither map nor file, in [0, 1]
  std::optional<std::size_t> own = {};  ///< of BakeOptions::own
  bool is_inverted = false;             ///< 1 less it; what runs from -1 to 1, with its sign changed
};

/// One more file.
struct PackedTexture {
  std::string name;                     ///< what BakeOptions::name calls its {map}
  std::vector<PackedChannel> channels;  ///< one, three or four
  bool is_srgb = false;                 ///< integers are encoded as sRGB, alpha excepted
};

/// Light that is no even sky's.
struct GivenIrradiance {
  std::vector<TexelVector> channels = {};  ///< E₀/π: one, or red, green and blue
  std::string description = {};
  double rmse = 0;  ///< of it, where that was found
};

struct Material;
struct ReportedBake;

constexpr std::uint64_t kSheetBytes = std::uint64_t{32} << 20;

struct BakeOptions {
  std::vector<MaterialMap> maps;  ///< each in a file of its own
  std::vector<PackedTexture> packed;
  std::vector<OwnChannel> own;        ///< channels of files that packs take
  std::string name = "{stem}_{map}";  ///< of files, without extension; {material}, too (material_name)
  bool uniform_ao = false;            ///< α in place of A
  Albedo albedo{.constant = {0.5}};   ///< of multibounce
  std::optional<MaximumDistance> maximum_distance =
      {};  ///< of ao, bent normals and cones, horizons, sh and definitions; not of multibounce, ao_n
  bool y_down = false;       ///< as Direct3D has it, where OpenGL has y up
  bool bent_length = false;  ///< alpha of bent normals: |(3/2π) ∫ V ω cosθ dω|, 1 = open
  int horizon_azimuths = 4;  ///< N: toward 2π k/N
  /// From where these count; default `north` where the map is open, else `math`, toward the y of the files
  std::optional<AzimuthConvention> azimuth_convention = {};
  Gloss gloss = {};            ///< of specular_occlusion, which knows no maximum distance
  Vector3 view = {0, 0, 1};    ///< and toward the viewer; world axes, z > 0
  double normal_strength = 1;  ///< of `normal`: slopes are multiplied by it; 1 is the surface's own
  /// Standard deviation of the Gaussian mean that curvature and cavity are of, in world units, ≥ 0 (of a
  /// cavity > 0); default 0.25 % of the width
  std::optional<double> detail_scale = {};
  double midlevel = 0.5;  ///< of displacement: the height that is none, over the relief, in [0, 1]
  DisplacementUnit displacement_unit = DisplacementUnit::metre;
  /// Of all maps of light; not with ao_n, specular_occlusion
  BelowHorizontal below = BelowHorizontal::sky;
  TextureFormat format = TextureFormat::png;
  TextureDepth depth = TextureDepth::uint16;
  bool dither = false;             ///< blue noise instead of rounding; 8 bits only
  double error = 0.002;            ///< RMSE wanted of A, of the total, and of specular_occlusion
  int azimuths = 0;                ///< > 0: those of the sky, fixed
  std::uint64_t seed = 1;          ///< of calibration, check and dither
  std::uint64_t memory = ~0ULL;    ///< bytes that all of it may take
  std::size_t light_channels = 0;  ///< > 0: multibounce and direct are of another light than an even sky
  std::function<GivenIrradiance(const Surface&)> find_light =
      {};  ///< which this finds, with so many channels
  /// Where it is set, it writes NAME_report.html, a page for browsers.
  std::function<void(const std::filesystem::path&, const ReportedBake&)> write_report = {};
  /// Draws NAME_sheet.png; none where empty. It sees ao, bent normals and multibounce, which are found for
  /// it, and may take kSheetBytes and two maps of the surface's size.
  std::function<Image<Rgb8>(const Material&, const Albedo&)> draw_sheet = {};
  Watch watch = {};              ///< of the solution
  std::string projection = {};   ///< text of the .prj that goes beside each Esri grid; empty: none does
  std::string relief_from = {};  ///< how the relief was found, for the sidecar; empty: it was not
  std::string request = {};      ///< what was asked for, as the asker knows it again; stands in the sidecar
  std::string surface = {};      ///< likewise the heights alone: earlier maps of the same ones stay
};

/// Names of files that baking writes alike for every map: shaders, and the tables that they read.
std::vector<std::string> shared_files(const BakeOptions& options);

/// Names of all files that baking writes for a map of that name, the sidecar last.
std::vector<std::string> baked_files(const std::string& name, const BakeOptions& options);

/// Where what is baked goes, and what it is called.
struct BakeTarget {
  std::filesystem::path source;  ///< the heightmap's file, for the sidecar
  InputGuard inputs;             ///< that it was baked from, or others will be
  std::filesystem::path folder;
  std::string name;  ///< what the files' names begin with
};

/// The heights that maps are made of, as their file tells of them.
struct HeightSource {
  SourceFacts facts = {};
  std::optional<Georeference> place = {};  ///< which GeoTIFFs and grids keep
};

/// What a user should be told of a bake.
struct BakeOutcome {
  std::vector<Warning> warnings;
  std::vector<std::string> removed;  ///< maps of an earlier bake of that name, of other heights
};

/// Makes the maps of a heightmap and writes them as NAME_ao.png …, with NAME_bake.json, which says what each
/// file holds, how it was found and what it errs by; all or none. One visibility pass serves all of them (two
/// where both a maximum distance and bounces are wanted; toward the azimuths of horizon maps more). No input
/// is replaced. Throws UsageError for options that contradict each other, Error when it can't be done.
BakeOutcome bake_material(LoadedHeightmap loaded, const BakeOptions& options, const BakeTarget& target);

/// The same of a material that was found (material.h), by the same options.
BakeOutcome write_material(const Material& material, const HeightSource& source, const BakeOptions& options,
                           const BakeTarget& target);

/// Throws UsageError where two of baked_files would have one name, or one would be no name of a file.
void check_file_names(const std::string& name, const BakeOptions& options);

/// Throws UsageError, naming the option, for what no map can be baked with.
void check_bake_options(const BakeOptions& options);

}  // namespace heightlight
