#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/albedo.h"
#include "cli/map_options.h"
#include "cli/visibility_options.h"
#include "heightlight/transport.h"

namespace heightlight {

/// What `heightlight simulate` was asked for.
struct SimulateOptions {
  MapOptions map;
  RunOptions run;
  std::string sha256;  ///< what the map's file must have; empty: whatever it has
  std::filesystem::path folder;
  VisibilityOptions visibility;
  int bounces = 20;
  int bins = 100;
  std::string albedo = "0.5";
  bool save_bounces = false;
};

/// Seconds that each step took.
struct StepTimes {
  double load = 0;
  double visibility = 0;
  double transport = 0;  ///< setting up the operator: for stored links, counting and checking them
  double bounces = 0;
  double check = 0;   ///< estimating the errors
  double curves = 0;  ///< binning, the curves' table, the study of the relief
  double output = 0;  ///< maps, plots and pictures
  double total = 0;
};

/// What must hold of any surface, as measured on this one.
struct EnergyCheck {
  double row_sum_max_error = 0;   ///< |sky + Σ F − 1|
  double sum_max_error = 0;       ///< |E₀ + … + E_K + tail − 1| at ρ = 1, in units of π
  double mean_total_over_pi = 1;  ///< mean of that sum
  double tail_mean = 0;           ///< of the tail after K bounces at ρ = 1, E/π
  double tail_max = 0;
  double spectral_radius = 0;
  double solver_residual = 0;  ///< largest relative residual of the linear solves
  int solver_iterations = 0;   ///< largest number of iterations among them
};

/// The mean sky view factor of what texels see, weighted by how much of it they see.
struct SeenSky {
  double expected = 1;  ///< by reciprocity, from the sky view factor and the normals alone
  double deep = 1;      ///< t of the models: what the deepest places see, tuned to the whole map
  double mean = 1;  ///< as the first bounce brings it; the two part where samples don't resolve the surface
};

/// Everything that the summary reports.
struct Simulation {
  SourceFacts facts;
  int width = 0;  ///< of the map, in texels
  int height = 0;
  std::optional<HorizonPlan> plan;      ///< of fast horizon walks
  std::optional<double> rmse_estimate;  ///< of A; absent where no receiver is
  std::optional<HorizonCheck> check;    ///< of horizon walks
  std::uint64_t links = 0;
  std::uint64_t link_bytes = 0;
  SeenSky seen;
  EnergyCheck energy;
  StepTimes seconds;
};

/// Throws UsageError naming the option that is out of its range or contradicts another.
void check_simulate_options(const SimulateOptions& options);

/// All that `heightlight simulate` does for one map, from its file to the committed folder. `options.run` has
/// been applied. Throws Error naming what could not be done, OutputError where a result could not be written,
/// UsageError, Interrupted; the folder then is as it was.
Simulation simulate_map(const SimulateOptions& options);

/// Writes `summary.json`. Throws OutputError.
void write_summary(const std::filesystem::path& path, const SimulateOptions& options, const Surface& surface,
                   const Albedo& albedo, const Simulation& simulation);

}  // namespace heightlight
