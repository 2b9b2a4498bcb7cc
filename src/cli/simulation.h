#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/albedo.h"
#include "cli/light_options.h"
#include "cli/map_options.h"
#include "cli/plots.h"
#include "cli/visibility_options.h"
#include "files/file_record.h"
#include "files/staged_output.h"
#include "heightlight/files.h"
#include "heightlight/watch.h"

namespace heightlight {

/// What `heightlight simulate` was asked for.
struct SimulateOptions {
  MapOptions map;
  RunOptions run;
  std::string sha256;                ///< what the map's file must have; empty: whatever it has
  std::string albedo_sha256;         ///< likewise
  std::string key;                   ///< of the run in a dataset, for its summary; empty: it is in none
  std::optional<InputGuard> inputs;  ///< that results must not replace; absent: the map and the albedo
  std::filesystem::path folder;
  VisibilityOptions visibility;
  int bounces = 20;
  int bins = 100;
  std::string albedo = "0.5";
  LightOptions light = {};  ///< of the total; bounces and curves are those of an even sky
  bool save_bounces = false;
  bool save_links = false;
  bool report = false;           ///< also write report.html
  std::string obscurance;        ///< a distance, up to which occluders count; empty: it is not asked for
  std::string falloff = "sqrt";  ///< of the occluders within it
};

/// Seconds that each step took beside the solution's own.
struct StepTimes {
  double load = 0;
  double light = 0;   ///< finding a light of one's own
  double curves = 0;  ///< binning, the curves' table, the study of the relief
  double output = 0;  ///< maps, plots and pictures
  double total = 0;
};

/// Everything that the summary reports.
struct Simulation {
  SourceFacts facts;
  int width = 0;  ///< of the map, in texels
  int height = 0;
  Evidence evidence;
  std::string light;  ///< of the total, in words; empty: an even sky's
  double light_rmse = 0;
  std::vector<Warning> warnings;  ///< of the map, and of an error that was missed
  StepTimes seconds;
  std::vector<std::string> removed;  ///< files of an earlier result
  std::vector<FileRecord> files;     ///< that the folder holds beside the summary
};

/// Throws UsageError naming the option that is out of its range or contradicts another.
void check_simulate_options(const SimulateOptions& options);

/// All that `heightlight simulate` does for one map, from its file to the committed folder. `options.run` has
/// been applied. Throws Error naming what could not be done, OutputError where a result could not be written,
/// UsageError, Cancelled; the folder then is as it was.
Simulation simulate_map(const SimulateOptions& options, Plots& plots, const Watch& watch);

/// Writes `summary.json`. Throws OutputError.
void write_summary(const std::filesystem::path& path, const SimulateOptions& options, const Surface& surface,
                   const Albedo& albedo, const Simulation& simulation);

}  // namespace heightlight
