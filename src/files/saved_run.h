#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/file_record.h"
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
  std::vector<FileRecord> files;  ///< of the run, as they were written
};

/// The summary beside `curves`; nothing where there is none, or where it does not speak of a file of that
/// name. Throws Error naming the file where the summary is damaged or tells less than today's, or where the
/// curves are not those that it records: files of several runs are mixed.
std::optional<RunSummary> read_run_summary(const std::filesystem::path& curves);

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

/// Whether the run kept its bounces apart: irradiance_00.exr, irradiance_01.exr, ….
bool has_saved_texels(const RunSummary& run);

/// Reads them from the run's folder and sums them up: Σ ρ^b E_b, and conserve_tail for what comes after the
/// last. Throws Error naming the file that is missing, damaged, of another size or of another run, or when
/// `memory_limit` bytes don't hold them.
SavedTexels read_saved_texels(const std::filesystem::path& folder, const RunSummary& run,
                              const std::vector<double>& albedos, std::uint64_t memory_limit);

}  // namespace heightlight
