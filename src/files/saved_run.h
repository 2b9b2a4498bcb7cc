#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/image.h"

namespace heightlight {

/// What `simulate` says of itself in summary.json, as far as fits want to know it.
struct RunSummary {
  std::string map;     ///< the heightmap's file name, without folder and extension
  std::string sha256;  ///< of that file
  bool tiles = true;
  double relief = 0;         ///< peak to valley, world units
  double texel_x = 0;        ///< spacing along the rows
  double width = 0;          ///< world units
  double expected_seen = 1;  ///< s, as SeenSky in the summary
  double measured_seen = 1;
};

/// The summary beside a CURVES.csv; nothing where there is none. Throws Error naming the file where it is
/// damaged, or was written before it told what texels see.
std::optional<RunSummary> read_run_summary(const std::filesystem::path& folder);

/// What `simulate --save-bounces` left of every texel, brought to totals: all maps of one size, E/π, NaN
/// where missing.
struct SavedTexels {
  Map ambient_occlusion;
  Map sky_view_factor;
  Map first_bounce;         ///< E₁/π at ρ = 1
  std::vector<Map> totals;  ///< of all bounces, per albedo asked for
};

/// "irradiance_07.exr": what holds bounce 7.
std::string bounce_file(int bounce);

/// Whether the folder holds bounces apart: irradiance_00.exr and irradiance_01.exr.
bool has_saved_texels(const std::filesystem::path& folder);

/// Reads them and sums them up: Σ ρ^b E_b, and conserve_tail for what comes after the last. Throws Error
/// naming the file that is missing, damaged or of another size, or when `memory_limit` bytes don't hold them.
SavedTexels read_saved_texels(const std::filesystem::path& folder, const std::vector<double>& albedos,
                              std::uint64_t memory_limit);

}  // namespace heightlight
