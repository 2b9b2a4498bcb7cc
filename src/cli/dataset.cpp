#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <set>
#include <system_error>

#include "base/progress.h"
#include "base/stopwatch.h"
#include "cli/commands.h"
#include "cli/dataset_runs.h"
#include "cli/dataset_tables.h"
#include "cli/manifest.h"
#include "cli/memory_promise.h"
#include "cli/tell.h"
#include "cli/terminal_watch.h"
#include "cli/user_message.h"
#include "cli/warnings.h"
#include "files/folder_lock.h"
#include "files/image_file.h"
#include "files/map_size.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/synth.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

struct DatasetOptions {
  fs::path manifest;
  fs::path folder;
  RunOptions run;
};

void make_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw output_error(folder, failure.message());
}

/// All files that a job reads.
std::vector<fs::path> input_files(const Manifest& manifest) {
  std::vector<fs::path> inputs{manifest.path};
  for (const ManifestMap& map : manifest.maps) {
    if (!map.is_shape()) inputs.push_back(map.file);
  }
  for (const ManifestOptions& options : manifest.options) {
    if (!options.albedo_file.empty()) inputs.push_back(options.simulate.albedo);
  }
  return inputs;
}

/// Writes the shape that a run is to read, once in the life of this process: what lies there may be an older
/// version's.
void make_shape(const DatasetRun& run, const std::vector<fs::path>& inputs,
                std::set<const ManifestMap*>& made) {
  const ManifestMap& map = *run.map;
  if (!map.is_shape() || made.contains(&map)) return;
  const fs::path& path = run.simulate.map.path;
  const auto side = static_cast<std::uint64_t>(map.size);
  constexpr std::uint64_t kBytesPerTexel = 16;  // heights beside what they are made from
  keep_promise(run.simulate.run,
               [&] { check_map_size(path, side, side, kBytesPerTexel, run.simulate.run.memory); });
  make_folder(path.parent_path());
  const Image<float> heights = synthesize(map.source, map.size, map.seed);
  StagedFile file(path, inputs);
  write_float_image(file.path(), {{"Y", &heights}});
  file.commit();
  made.insert(&map);
}

/// What the runs of a job share: its plots, shapes that were made, warnings that were told.
struct JobState {
  Plots& plots;
  std::set<const ManifestMap*> made = {};
  std::set<std::string> told = {};
};

/// Of a map's many runs, each warning is told once; the summary of each has all of its own.
void tell_new_warnings(const DatasetRun& run, const std::vector<Warning>& warnings,
                       std::set<std::string>& told) {
  for (const Warning& warning : warnings) {
    if (told.insert(run.map->name + '\n' + warning.message).second) tell_warnings(run.name, {warning});
  }
}

/// Whether something stands where the run's folder belongs. Then it fails alone; what else a run cannot
/// write, none can.
bool is_in_the_way(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(fs::symlink_status(folder, ignored)) && !fs::is_directory(folder, ignored);
}

/// Why a run failed. Where results cannot be written, no run can do anything, and the job ends.
std::string try_run(const DatasetRun& run, const std::vector<fs::path>& inputs, JobState& state,
                    const Watch& watch) {
  try {
    make_shape(run, inputs, state.made);
    tell_new_warnings(run, simulate_map(run.simulate, state.plots, watch).warnings, state.told);
    return "";
  } catch (const OutputError& error) {
    if (!is_in_the_way(run.simulate.folder)) throw;
    return user_message(error);
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception& error) {
    return user_message(error);
  }
}

void tell_fault(const DatasetRun& run) { tell(run.name + ": " + run.fault); }

/// Does what is to be done, in the manifest's order.
void do_runs(const std::vector<DatasetRun*>& runs, const std::vector<fs::path>& inputs, Plots& plots,
             bool quiet) {
  const Watch jobs = terminal_watch(quiet);
  Progress progress("dataset", static_cast<std::int64_t>(runs.size()), jobs);
  JobState state{.plots = plots};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    DatasetRun& run = *runs[i];
    const Watch watch = terminal_watch(quiet, fmt::format("run {} of {}: ", i + 1, runs.size()));
    Stopwatch lap;
    run.fault = try_run(run, inputs, state, watch);
    if (!run.fault.empty()) {
      tell_fault(run);
    } else if (!quiet) {
      fmt::print("{}: {:.1f} s\n", printable(run.name), lap.lap());
      std::fflush(stdout);
    }
    progress.add(1);
  }
}

/// Folders in runs/ that no run of the manifest has: of maps or options that were changed or left out.
std::ptrdiff_t count_stale(const std::vector<DatasetRun>& runs, const fs::path& folder) {
  std::set<std::string> names;
  for (const DatasetRun& run : runs) names.insert(run.name);
  std::error_code ignored;
  return std::count_if(fs::directory_iterator(runs_folder(folder), ignored), fs::directory_iterator(),
                       [&](const fs::directory_entry& entry) {
                         const std::string name = entry.path().filename().string();
                         return !name.starts_with('.') && !names.contains(name);
                       });
}

/// A process that was killed when a result was in place has left what no result of this job may come across.
void tidy(const std::vector<DatasetRun>& runs, const fs::path& folder) {
  for (const fs::path& place : {folder, runs_folder(folder), shapes_folder(folder)})
    remove_left_behind(place);
  for (const DatasetRun& run : runs) remove_left_behind(run.simulate.folder);
}

void make_dataset(DatasetOptions& options) {
  apply_run_options(options.run);
  const Manifest manifest = read_manifest(options.manifest);
  const std::vector<fs::path> inputs = input_files(manifest);
  refuse_to_replace(inputs, options.folder);
  make_folder(options.folder);
  const FolderLock lock(options.folder);
  std::vector<DatasetRun> runs = list_runs(manifest, options.folder, options.run);
  tidy(runs, options.folder);
  const InputGuard guard(inputs);
  for (DatasetRun& run : runs) run.simulate.inputs = guard;
  Plots plots;
  std::vector<DatasetRun*> to_do;
  for (DatasetRun& run : runs) {
    if (!run.fault.empty()) {
      tell_fault(run);
    } else if (!is_done(run, plots.possible())) {
      to_do.push_back(&run);
    }
  }
  if (!options.run.quiet) {
    fmt::print("{}: {} runs, {} of them to do\n", printable(options.manifest), runs.size(), to_do.size());
    std::fflush(stdout);
  }
  make_folder(runs_folder(options.folder));
  do_runs(to_do, inputs, plots, options.run.quiet);
  write_tables(manifest, runs, options.folder, inputs);
  const auto failed =
      std::count_if(runs.begin(), runs.end(), [](const DatasetRun& run) { return !run.fault.empty(); });
  if (!options.run.quiet) {
    const std::ptrdiff_t stale = count_stale(runs, options.folder);
    if (stale > 0) fmt::print("{} folders in runs/ belong to no run of the manifest any more\n", stale);
    fmt::print("results in {}\n", printable(options.folder));
  }
  if (failed > 0) {
    throw Error(options.manifest.string() + ": " + std::to_string(failed) + " of " +
                std::to_string(runs.size()) + " runs could not be done");
  }
  plots.check();
}

}  // namespace

void add_dataset_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("dataset", "Simulate many maps, reliefs and options into one table");
  auto options = std::make_shared<DatasetOptions>();
  command->add_option("MANIFEST", options->manifest, "what to simulate, as JSON; see below")->required();
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  add_resource_options(*command, options->run);
  command->footer(
      describe_manifest() +
      "Results: dataset.csv (all curves), dataset.json (where they come from, how far to trust them),\n"
      "costs.csv (seconds), and in runs/ a folder per run with what simulate writes. Stopped or killed, the\n"
      "same command goes on where it was; runs whose map, options or version changed are made again. What\n"
      "is no longer in the manifest leaves the tables; its folder stays, and counts again when it returns.\n"
      "Example:\n"
      "  heightlight dataset study.json -o study");
  command->callback([options] { make_dataset(*options); });
}

}  // namespace heightlight
