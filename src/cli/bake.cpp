#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <map>

#include "bake/bake_memory.h"
#include "base/progress.h"
#include "base/stopwatch.h"
#include "cli/albedo.h"
#include "cli/bake_command.h"
#include "cli/bake_report.h"
#include "cli/bake_windows.h"
#include "cli/commands.h"
#include "cli/json_line.h"
#include "cli/map_options.h"
#include "cli/memory_promise.h"
#include "cli/name_errors.h"
#include "cli/pack_options.h"
#include "cli/reach_options.h"
#include "cli/relief_match.h"
#include "cli/tell.h"
#include "cli/terminal_watch.h"
#include "cli/user_message.h"
#include "cli/warnings.h"
#include "files/file_format.h"
#include "files/image_file.h"
#include "files/input_file.h"
#include "files/json_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// All files that a batch reads, and those of its folders that it leaves out. An albedo that is a number
/// names no file.
InputGuard guard_inputs(const BakeCommand& command, const BakeInputs& listed) {
  std::vector<std::filesystem::path> files = listed.left_out;
  files.emplace_back(command.albedo);
  files.push_back(command.pack.preset_file);
  files.emplace_back(command.match);
  files.emplace_back(command.reliefs);
  for (const std::filesystem::path& path : light_files(command.light)) files.push_back(path);
  for (const BakeInput& input : listed.inputs) {
    files.push_back(input.path);
    files.push_back(std::filesystem::path(input.path).replace_extension(".prj"));
    for (const OwnChannel& own : own_channels_for(command.options, input.path)) files.push_back(own.path);
  }
  return files;
}

/// Files that one map's baking writes, and no other's. Throws UsageError where a map before has such a file.
void take_names(const BakeInput& input, const BakeOptions& options,
                std::map<std::string, std::filesystem::path>& owners) {
  check_file_names(input.name, options);
  const std::vector<std::string> shared = shared_files(options);
  for (const std::string& name : baked_files(input.name, options)) {
    if (std::find(shared.begin(), shared.end(), name) != shared.end()) continue;
    const auto [owner, is_new] = owners.emplace(name, input.path);
    if (!is_new)
      throw UsageError("name", options.name,
                       "files of " + owner->second.string() + " and " + input.path.string() +
                           " would both be called " + name);
  }
}

/// Before anything is baked: all can be, files of one's own are there, and no map's files replace any input,
/// nor another map's.
void check_batch(const BakeCommand& command, const BakeInputs& listed, const InputGuard& guard) {
  std::map<std::string, std::filesystem::path> owners;
  for (const BakeInput& input : listed.inputs) {
    const BakeCommand own = command_for(command, input.path);
    check_load_options(own.load);
    const BakeOptions options = options_for(own, input.path);
    BakeOptions widest = options;
    widest.albedo.constant.resize(3);  // how many channels it has, a file may have to tell
    check_bake_options(widest);
    take_names(input, options, owners);
    for (const OwnChannel& channel : options.own) InputFile{channel.path};
    for (const std::string& name : baked_files(input.name, options)) guard.check(command.folder / name);
  }
}

BakeOutcome bake_within(const BakeCommand& command, const BakeInput& input, const InputGuard& guard,
                        bool quiet) {
  BakeOptions options = options_for(command, input.path);
  options.watch = terminal_watch(quiet);
  options.albedo = announced_albedo(command.albedo);
  LoadedHeightmap loaded =
      load_heightmap(input.path, command.load, command.run.memory, [&](int width, int height) {
        return bake_bytes(width, height, options) + bake_report_bytes(width, height, options);
      });
  ReadAlbedo albedo = read_albedo(command.albedo, loaded.map, command.run.memory);
  options.albedo = std::move(albedo.albedo);
  if (!command.max_distance.empty()) {
    const double width = loaded.map.spacing.x * loaded.map.height.width;
    options.maximum_distance =
        MaximumDistance{.distance = parse_distance("max_distance", command.max_distance, width),
                        .falloff = falloff_named(command.falloff)};
  }
  if (!command.detail_scale.empty())
    options.detail_scale =
        parse_distance("detail_scale", command.detail_scale, loaded.map.spacing.x * loaded.map.height.width);
  if (options.light_channels > 0) {
    options.find_light = [&](const Surface& surface) {
      DirectIrradiance light = find_direct_irradiance(command.light, surface,
                                                      {.error = options.error,
                                                       .seed = options.seed,
                                                       .memory = memory_beside(command.run, surface),
                                                       .watch = options.watch});
      return GivenIrradiance{.channels = std::move(light.channels),
                             .description = std::move(light.description),
                             .rmse = light.rmse};
    };
  }
  const std::uint64_t albedo_bytes =
      options.albedo.varying.size() * loaded.map.height.size() * sizeof(TexelVector::value_type);
  read_own_channels(options.own, loaded.map, command.run.memory - std::min(command.run.memory, albedo_bytes));
  options.surface = surface_of(command, options, loaded.facts.sha256);
  options.request = request_of(command, options, loaded.facts.sha256, albedo.sha256);
  const BakeTarget target{
      .source = input.path, .inputs = guard, .folder = command.folder, .name = input.name};
  return name_errors(input.path, [&] { return bake_material(std::move(loaded), options, target); });
}

/// In one piece where memory holds that, unless it is not to be; else window by window, where that can be.
BakeOutcome bake_file(const BakeCommand& asked, const BakeInput& input, const InputGuard& guard, bool quiet) {
  return keep_promise(asked.run, [&] {
    const BakeCommand command = asked.match.empty() ? asked : with_matched_relief(asked, input);
    if (!command.window.empty()) return bake_one_window(command, input, guard, quiet);
    if (command.windows) return bake_by_windows(command, input, guard, quiet);
    try {
      return bake_within(command, input, guard, quiet);
    } catch (const MemoryError&) {
      if (recognise_format(input.path) != FileFormat::tiff || !can_be_windowed(command, input)) throw;
    }
    return bake_by_windows(command, input, guard, quiet);
  });
}

/// How a batch went.
struct Tally {
  std::size_t baked = 0;
  std::size_t skipped = 0;
  std::vector<std::string> faults;  ///< one line each
};

/// What the map's sidecar says of it, after it was baked or was found to be there.
MapLine described_line(const BakeCommand& command, const BakeInput& input, const char* status) {
  const std::vector<std::string> names = baked_files(input.name, options_for(command, input.path));
  const nlohmann::json sidecar = read_json(command.folder / names.back());
  return {.map = input.path,
          .status = status,
          .files = paths_in(command.folder, names),
          .errors = nlohmann::ordered_json(sidecar.value("errors", nlohmann::json())),
          .warnings = {},
          .removed = {},
          .fault = {},
          .seconds = 0};
}

void bake_one(const BakeCommand& command, const BakeInput& input, const InputGuard& guard, bool only_one,
              Tally& tally) {
  Stopwatch watch;
  if (command.skip_existing && is_baked(command, input)) {
    remove_left_behind(command.folder);  // of a process that was killed when all was in place
    ++tally.skipped;
    if (command.json) print_json_line(described_line(command, input, "skipped"));
    return;
  }
  const BakeOutcome outcome = bake_file(command, input, guard, command.run.quiet || !only_one);
  ++tally.baked;
  tell_warnings(input.path, outcome.warnings);
  if (command.json) {
    MapLine line = described_line(command, input, "done");
    line.warnings = warning_texts(outcome.warnings);
    line.removed = outcome.removed;
    line.seconds = watch.lap();
    print_json_line(line);
  } else if (!command.run.quiet) {
    report_removed(outcome.removed);
  }
}

/// What was wrong with a map, in one line that names it.
std::string fault_of(const BakeInput& input, const std::exception& error) {
  const bool names_map = dynamic_cast<const Error*>(&error);
  return (names_map ? "" : input.path.string() + ": ") + user_message(error);
}

void report(const BakeCommand& command, const Tally& tally) {
  if (command.run.quiet || command.json) return;
  fmt::print("{} baked, {} skipped, {} failed; results in {}\n", tally.baked, tally.skipped,
             tally.faults.size(), printable(command.folder));
}

/// Files of folders that by their names are no heights.
void tell_left_out(const BakeInputs& listed) {
  if (listed.left_out.empty()) return;
  const bool one = listed.left_out.size() == 1;
  tell(std::to_string(listed.left_out.size()) +
       (one ? " file was left out, since it is named like another kind of map: "
            : " files were left out, since they are named like other kinds of maps: ") +
       listed.left_out.front().filename().string() + (one ? "" : ", …") + "; --pattern can choose them");
}

/// Names of the table that are no map's: typing errors, perhaps.
void tell_unused_reliefs(const BakeCommand& command, const BakeInputs& listed) {
  for (const NamedRelief& named : command.relief_table) {
    const bool is_used = std::any_of(listed.inputs.begin(), listed.inputs.end(), [&](const BakeInput& input) {
      return find_relief(command.relief_table, input.path) == &named;
    });
    if (!is_used) tell("warning: --reliefs: no map here is called " + printable(named.name));
  }
}

}  // namespace

void bake(BakeCommand& command) {
  apply_run_options(command.run);
  parse_bake_options(command);
  const BakeInputs listed = list_bake_inputs(command.inputs, command.pattern);
  const std::vector<BakeInput>& inputs = listed.inputs;
  tell_left_out(listed);
  tell_unused_reliefs(command, listed);
  if (!command.match.empty() && inputs.size() > 1)
    throw UsageError("match", "",
                     "is for a single map, but there are " + std::to_string(inputs.size()) + " maps");
  const InputGuard guard = guard_inputs(command, listed);
  check_batch(command, listed, guard);
  const bool only_one = inputs.size() == 1;
  Tally tally;
  {
    const Watch watch = terminal_watch(command.run.quiet || only_one);
    Progress progress("bake", static_cast<std::int64_t>(inputs.size()), watch);
    for (const BakeInput& input : inputs) {
      Stopwatch stopwatch;
      try {
        bake_one(command_for(command, input.path), input, guard, only_one, tally);
      } catch (const Cancelled&) {
        throw;
      } catch (const std::exception& error) {
        tally.faults.push_back(fault_of(input, error));
        if (command.json) print_json_line(failed_line(input.path, tally.faults.back(), stopwatch.lap()));
        if (only_one) throw;
      }
      progress.add(1);
    }
  }
  report(command, tally);
  if (tally.faults.empty()) return;
  for (const std::string& fault : tally.faults) tell(fault);
  throw Error(std::to_string(tally.faults.size()) + " of " + std::to_string(inputs.size()) +
              " maps could not be baked");
}

}  // namespace heightlight
