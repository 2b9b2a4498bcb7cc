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
    if (stale > 0) fmt::print("{} folders in runs/ belong to no run of the manifest any more\n", stale);
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
    throw UsageError(options.others[0].string() + ": only --merge takes in the runs of other folders");
  if (options.shard.empty()) return std::nullopt;
  const Shard shard = parse_shard(options.shard);
  if (options.merge)
    throw UsageError("shard", options.shard, "cannot be together with --merge, which takes all shards");
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
  command->add_option("MANIFEST", options->manifest, "what to simulate, as JSON; see below")->required();
  command->add_option("FOLDER", options->others,
                      "with --merge: other folders of this dataset, whose runs are taken in");
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  CLI::Option* shard =
      command
          ->add_option("--shard", options->shard,
                       "do share K of N of the runs, from 1 to N, and leave the tables to --merge")
          ->type_name("K/N");
  command->add_flag("--merge", options->merge, "write the tables from runs that are done; simulate nothing");
  add_report_option(*command, options->report);
  shard->excludes(command->get_option("--report"));
  add_resource_options(*command, options->run);
  command->footer(
      describe_manifest() +
      "Results: dataset.csv (all curves), dataset.json (where they come from, how far to trust them),\n"
      "costs.csv (seconds), and in runs/ a folder per run with what simulate writes. Stopped or killed, the\n"
      "same command goes on where it was; runs whose map, options or version changed are made again. What\n"
      "is no longer in the manifest leaves the tables; its folder stays, and counts again when it returns.\n"
      "Any number of processes may work in one DIR: each run is done by one of them. Without --shard, all "
      "of\n"
      "them end when every run is done, and write the same tables. A shard has the runs whose hash falls to\n"
      "it, and ends when those are done. --merge refuses folders that another version or another manifest\n"
      "made (origin.json in each tells). Where runs are missing, those that failed included, it says which,\n"
      "exits with 1 and writes nothing; without --merge, the tables come without the runs that fail.\n"
      "Examples:\n"
      "  heightlight dataset study.json -o study\n"
      "  heightlight dataset study.json -o study --shard 2/8     # 1/8 … 8/8, on machines that share a disk\n"
      "  heightlight dataset study.json -o study --merge\n"
      "  heightlight dataset study.json here there -o study --merge      # of machines that share none");
  command->callback([options] { make_dataset(*options); });
}

}  // namespace heightlight
