#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/manifest.h"
#include "cli/simulation.h"

namespace heightlight {

/// So many digits of its key end the name of a run.
constexpr std::size_t kNameDigits = 12;

/// One run of a dataset: what `simulate` is asked for, and what became of it. The names are those of the
/// manifest, which must outlive it.
struct DatasetRun {
  std::string name;  ///< of its folder: map, relief, boundary, options, and the first digits of `key`
  std::string key;   ///< SHA-256 of all that its results depend on; empty where the input cannot be read
  const ManifestMap* map = nullptr;
  const ManifestOptions* options = nullptr;
  std::optional<double> relief_share;  ///< nothing: the map's own
  std::optional<Boundary> boundary;    ///< nothing: the map's own
  SimulateOptions simulate;
  std::string fault;  ///< why it could not be done; empty where it was
};

/// Every run of a manifest, in its order, with results in `folder`. What files hold is part of each run's
/// key, so all are read once; one that cannot be read becomes the fault of its runs.
std::vector<DatasetRun> list_runs(const Manifest& manifest, const std::filesystem::path& folder,
                                  const RunOptions& run);

/// The folder of a dataset that holds those of its runs, and the one that holds shapes made for them.
std::filesystem::path runs_folder(const std::filesystem::path& folder);
std::filesystem::path shapes_folder(const std::filesystem::path& folder);

/// Whether the run's folder holds all its results as its summary records them, to the last byte; with its
/// plots, where those are wanted.
bool is_done(const DatasetRun& run, bool with_plots);

}  // namespace heightlight
