#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "cli/commands.h"
#include "cli/dataset_locks.h"
#include "cli/dataset_merge.h"
#include "cli/dataset_origin.h"
#include "cli/dataset_runs.h"
#include "cli/dataset_tables.h"
#include "cli/dataset_work.h"
#include "cli/manifest.h"
#include "cli/report_facts.h"
#include "cli/shard.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

struct DatasetOptions {
  fs::path manifest;
  std::vector<fs::path> others;  ///< whose runs a merge takes in
  fs::path folder;
  std::string shard;  ///< "K/N"; empty: all runs, and then the tables
  bool merge = false;
  bool report = false;
  RunOptions run;
};

/// A dataset to be made: all that its options lead to.
struct Dataset {
  const Manifest& manifest;
  nlohmann::ordered_json origin;
  std::vector<fs::path> inputs;
  std::vector<DatasetRun> runs;
};

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

/// Does the runs that are not done.
void make_runs(Dataset& dataset, const DatasetOptions& options, Plots& plots) {
  make_folder(runs_folder(options.folder));
  write_origin(dataset.origin, options.folder, dataset.inputs);
  remove_left_by_killed(dataset.runs, options.folder);
  std::vector<DatasetRun*> to_do;
  for (DatasetRun& run : dataset.runs) {
    if (!run.fault.empty()) {
      tell_fault(run);
    } else if (!is_done(run, plots.possible())) {
      to_do.push_back(&run);
    }
  }
  if (!options.run.quiet) {
    const std::string share = options.shard.empty() ? "" : ", shard " + options.shard;
    fmt::print("{}{}: {} runs, {} of them to do\n", printable(options.manifest), share, dataset.runs.size(),
               to_do.size());
    std::fflush(stdout);
  }
  do_runs(to_do, dataset.inputs, plots, options.run.quiet);
}

void check_runs(const Dataset& dataset) {
  const auto failed = std::count_if(dataset.runs.begin(), dataset.runs.end(),
                                    [](const DatasetRun& run) { return !run.fault.empty(); });
  if (failed == 0) return;
  throw Error(dataset.manifest.path.string() + ": " + std::to_string(failed) + " of " +
              std::to_string(dataset.runs.size()) + " runs could not be done");
}

void make_whole(Dataset& dataset, const DatasetOptions& options) {
  Plots plots;
  make_runs(dataset, options, plots);
  write_tables(dataset.origin, dataset.runs, options.folder, dataset.inputs, options.report);
  if (!options.run.quiet) {
    const std::ptrdiff_t stale = count_stale(dataset.runs, options.folder);
    if (stale > 0) fmt::print("{} folders in runs/ no longer belong to any run of the manifest\n", stale);
    fmt::print("results in {}\n", printable(options.folder));
  }
  check_runs(dataset);
  plots.check();
}

void make_shard(Dataset& dataset, const Shard& shard, const DatasetOptions& options) {
  std::erase_if(dataset.runs, [&](const DatasetRun& run) { return !has_run(shard, run.key); });
  Plots plots;
  make_runs(dataset, options, plots);
  if (!options.run.quiet)
    fmt::print("runs in {}; when all shards are done, --merge writes the tables\n",
               printable(options.folder));
  check_runs(dataset);
  plots.check();
}

void merge(const Dataset& dataset, const DatasetOptions& options) {
  const MergeFolders folders{.folder = options.folder, .others = options.others, .report = options.report};
  const std::ptrdiff_t taken = merge_runs(dataset.origin, dataset.runs, folders, dataset.inputs);
  if (options.run.quiet) return;
  fmt::print("{}: {} runs, {} of them taken in from other folders\nresults in {}\n",
             printable(options.manifest), dataset.runs.size(), taken, printable(options.folder));
}

/// The shard that was asked for, if any. Throws UsageError where options contradict each other.
std::optional<Shard> read_shard(const DatasetOptions& options) {
  if (!options.others.empty() && !options.merge)
    throw UsageError(options.others[0].string() +
                     ": runs of other folders can only be taken in with --merge");
  if (options.shard.empty()) return std::nullopt;
  const Shard shard = parse_shard(options.shard);
  if (options.merge)
    throw UsageError("shard", options.shard, "cannot be combined with --merge, which merges all shards");
  return shard;
}

void make_dataset(DatasetOptions& options) {
  const std::optional<Shard> shard = read_shard(options);
  apply_run_options(options.run);
  const Manifest manifest = read_manifest(options.manifest);
  Dataset dataset{.manifest = manifest,
                  .origin = describe_origin(manifest),
                  .inputs = input_files(manifest),
                  .runs = list_runs(manifest, options.folder, options.run)};
  refuse_to_replace(dataset.inputs, options.folder);
  const InputGuard guard(dataset.inputs);
  for (DatasetRun& run : dataset.runs) run.simulate.inputs = guard;
  if (shard) {
    make_shard(dataset, *shard, options);
  } else if (options.merge) {
    merge(dataset, options);
  } else {
    make_whole(dataset, options);
  }
}

}  // namespace

void add_dataset_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("dataset", "Simulate many maps, reliefs and options into one table");
  auto options = std::make_shared<DatasetOptions>();
  command
      ->add_option("MANIFEST", options->manifest, "JSON file that says what to simulate; its format is below")
      ->required();
  command->add_option("FOLDER", options->others,
                      "other folders of this dataset whose runs are taken in; only with --merge");
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  CLI::Option* shard =
      command
          ->add_option("--shard", options->shard,
                       "do only part K of N of the runs, with K from 1 to N; --merge writes the tables later")
          ->type_name("K/N");
  command->add_flag("--merge", options->merge,
                    "write the tables from the runs that are done, without simulating");
  add_report_option(*command, options->report);
  shard->excludes(command->get_option("--report"));
  add_resource_options(*command, options->run);
  command->footer(
      describe_manifest() +
      "Results: dataset.csv (all curves), dataset.json (their origin and their errors), costs.csv (seconds), "
      "and\n"
      "in runs/ one folder per run with the results of simulate. If the command was stopped or killed, the "
      "same\n"
      "command continues where it was. Runs whose map, options or version changed are done again. Runs that "
      "are\n"
      "no longer in the manifest leave the tables; their folders stay and count again if the runs return.\n"
      "Any number of processes may work in one DIR: each run is done by one of them. Without --shard, all "
      "of\n"
      "them end when every run is done, and write the same tables. A shard gets the runs that their hash "
      "assigns\n"
      "to it, and ends when those are done. --merge refuses folders made by another version or from another\n"
      "manifest (each folder has this in origin.json). If runs are missing or failed, --merge names them, "
      "exits\n"
      "with 1 and writes nothing; without --merge, the tables are written without the failed runs.\n"
      "Examples:\n"
      "  heightlight dataset study.json -o study\n"
      "  heightlight dataset study.json -o study --shard 2/8     # 1/8 … 8/8 on machines that share a disk\n"
      "  heightlight dataset study.json -o study --merge\n"
      "  heightlight dataset study.json here there -o study --merge      # runs of machines without a shared "
      "disk");
  command->callback([options] { make_dataset(*options); });
}

}  // namespace heightlight
