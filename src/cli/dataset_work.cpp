#include "cli/dataset_work.h"

#include <fmt/core.h>

#include <cstdio>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include "base/progress.h"
#include "base/stopwatch.h"
#include "cli/dataset_locks.h"
#include "cli/memory_promise.h"
#include "cli/tell.h"
#include "cli/terminal_watch.h"
#include "cli/user_message.h"
#include "cli/warnings.h"
#include "files/image_file.h"
#include "files/lock_file.h"
#include "files/map_size.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"
#include "heightlight/synth.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

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

/// What the runs of this process share: inputs, plots, shapes that were made, warnings that were told.
struct JobState {
  const std::vector<fs::path>& inputs;
  Plots& plots;
  bool quiet;
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
std::string try_run(const DatasetRun& run, JobState& state, const Watch& watch) {
  try {
    make_shape(run, state.inputs, state.made);
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

void report(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

/// Of a run that this process holds: another may have done it since this one looked.
void do_run(DatasetRun& run, JobState& state, const Watch& watch) {
  if (is_done(run, state.plots.possible())) {
    if (!state.quiet) report(printable(run.name) + ": done by another process");
    return;
  }
  Stopwatch lap;
  run.fault = try_run(run, state, watch);
  if (!run.fault.empty()) {
    tell_fault(run);
  } else if (!state.quiet) {
    report(fmt::format("{}: {:.1f} s", printable(run.name), lap.lap()));
  }
}

}  // namespace

void make_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw output_error(folder, failure.message());
}

void tell_fault(const DatasetRun& run) { tell(run.name + ": " + run.fault); }

void do_runs(const std::vector<DatasetRun*>& runs, const std::vector<fs::path>& inputs, Plots& plots,
             bool quiet) {
  const Watch jobs = terminal_watch(quiet);
  Progress progress("dataset", static_cast<std::int64_t>(runs.size()), jobs);
  JobState state{.inputs = inputs, .plots = plots, .quiet = quiet};
  std::size_t begun = 0;
  bool has_waited = false;
  for (std::vector<DatasetRun*> waiting = runs; !waiting.empty();) {
    std::vector<DatasetRun*> busy;
    for (DatasetRun* run : waiting) {
      const auto lock = LockFile::try_take(lock_path(*run));
      if (!lock) {
        busy.push_back(run);
        continue;
      }
      do_run(*run, state, terminal_watch(quiet, fmt::format("run {} of {}: ", ++begun, runs.size())));
      progress.add(1);
    }
    if (busy.size() == waiting.size()) {
      if (!quiet && !std::exchange(has_waited, true))
        report(fmt::format("waiting for {} runs of other processes", busy.size()));
      wait_for_locks();
    }
    waiting = std::move(busy);
  }
}

}  // namespace heightlight
