#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/file_record.h"
#include "heightlight/image.h"

namespace heightlight {

/// The parts of summary.json, which `simulate` writes, that fits need.
struct RunSummary {
  std::string map;     ///< the heightmap's file name, without folder and extension
  std::string sha256;  ///< checksum of that file
  bool tiles = true;
  double relief = 0;         ///< peak to valley, world units
  double texel_x = 0;        ///< spacing along the rows, world units
  double width = 0;          ///< world units
  double expected_seen = 1;  ///< s, as SeenSky in the summary
  double measured_seen = 1;
  std::vector<FileRecord> files;  ///< files of the run, as they were written
};

/// Reads the summary beside `curves`. Empty where there is none, or where it does not mention a file of that
/// name. Throws Error naming the file where the summary is damaged or lacks entries that today's summaries
/// have, or where the curves are not the ones that it records, because files of several runs are mixed.
std::optional<RunSummary> read_run_summary(const std::filesystem::path& curves);

/// Maps that `simulate --save-bounces` saved, with bounces summed to totals. All maps have one size;
/// irradiance is E/π; NaN where missing.
struct SavedTexels {
  Map ambient_occlusion;
  Map sky_view_factor;
  Map first_bounce;         ///< E₁/π at ρ = 1
  std::vector<Map> totals;  ///< total irradiance / π, one map per albedo asked for
};

/// Name of the file that holds a bounce: "irradiance_07.exr" for bounce 7.
std::string bounce_file(int bounce);

/// Whether the run saved its bounces separately: irradiance_00.exr, irradiance_01.exr, ….
bool has_saved_texels(const RunSummary& run);

/// Reads the maps from the run's folder and sums the bounces: Σ ρ^b E_b, plus conserve_tail for all bounces
/// after the last saved one. Throws Error naming a file that is missing, damaged, of another size or of
/// another run, and where `memory_limit` bytes do not hold the maps.
SavedTexels read_saved_texels(const std::filesystem::path& folder, const RunSummary& run,
                              const std::vector<double>& albedos, std::uint64_t memory_limit);

}  // namespace heightlight
