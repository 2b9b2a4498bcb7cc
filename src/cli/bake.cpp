#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <map>
#include <memory>

#include "bake/bake_memory.h"
#include "base/progress.h"
#include "base/stopwatch.h"
#include "cli/albedo.h"
#include "cli/bake_command.h"
#include "cli/bake_report.h"
#include "cli/commands.h"
#include "cli/json_line.h"
#include "cli/map_options.h"
#include "cli/memory_promise.h"
#include "cli/name_errors.h"
#include "cli/pack_options.h"
#include "cli/preset.h"
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
#include "report/preview.h"
#include "windows/bake_window.h"
#include "windows/windowed_bake.h"

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
    options.reach = Reach{.distance = parse_distance("max_distance", command.max_distance, width),
                          .falloff = falloff_named(command.falloff)};
  }
  if (!command.detail_scale.empty())
    options.detail_scale =
        parse_distance("detail_scale", command.detail_scale, loaded.map.spacing.x * loaded.map.height.width);
  if (options.light_channels > 0) {
    options.find_light = [&](const Surface& surface) {
      DirectLight light = find_direct_light(command.light, surface,
                                            {.error = options.error,
                                             .seed = options.seed,
                                             .memory = memory_beside(command.run, surface),
                                             .watch = options.watch});
      return BakedLight{.channels = std::move(light.channels),
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

/// Of a map that is baked window by window, all that can be told without reading it.
WindowedTask windowed_task(const BakeCommand& command, const BakeInput& input) {
  WindowedTask task{.map = input.path, .load = command.load, .options = options_for(command, input.path)};
  task.options.albedo = announced_albedo(command.albedo);
  const std::uint64_t report = bake_report_bytes(kLargestPreview, kLargestPreview, task.options);
  task.options.memory -= std::min(task.options.memory, report);
  task.folder = command.folder / ("." + input.name + ".windows");
  if (!command.max_distance.empty()) {
    task.reach = [&command](double width) {
      return Reach{.distance = parse_distance("max_distance", command.max_distance, width),
                   .falloff = falloff_named(command.falloff)};
    };
  }
  return task;
}

bool can_be_windowed(const BakeCommand& command, const BakeInput& input) {
  try {
    check_windowed(windowed_task(command, input));
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

/// The same, once it is known that windows can do it, with what tells it from other requests.
WindowedTask requested_task(const BakeCommand& command, const BakeInput& input, bool quiet) {
  WindowedTask task = windowed_task(command, input);
  check_windowed(task);
  const std::string sha256 = sha256_of_file(input.path);
  task.options.surface = surface_of(command, task.options, sha256);
  task.options.request = request_of(command, task.options, sha256, "");
  task.options.watch = terminal_watch(quiet);
  return task;
}

/// Window by window. The work goes on where it was, when an earlier process was stopped.
BakeOutcome bake_by_windows(const BakeCommand& command, const BakeInput& input, const InputGuard& guard,
                            bool quiet) {
  WindowedTask task = requested_task(command, input, quiet);
  const BakeTarget target{
      .source = input.path, .inputs = guard, .folder = command.folder, .name = input.name};
  return name_errors(input.path,
                     [&] { return bake_in_windows(std::move(task), command.windows.value_or(0), target); });
}

/// COLUMN,ROW,WIDTH,HEIGHT.
MapRect parse_window(const std::string& text) {
  std::array<int, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [stop, fault] = std::from_chars(at, end, numbers[i]);
    const bool goes_on = i + 1 < numbers.size();
    if (fault != std::errc() || (goes_on ? stop == end || *stop != ',' : stop != end))
      throw UsageError("window", text, "write COLUMN,ROW,WIDTH,HEIGHT, such as 2048,1024,512,512");
    at = stop + 1;
  }
  return {.first_row = numbers[1], .first_column = numbers[0], .rows = numbers[3], .columns = numbers[2]};
}

/// A window of the map alone.
BakeOutcome bake_one_window(const BakeCommand& command, const BakeInput& input, const InputGuard& guard,
                            bool quiet) {
  const MapRect window = parse_window(command.window);
  const WindowedTask task = requested_task(command, input, quiet);
  const BakeTarget target{
      .source = input.path, .inputs = guard, .folder = command.folder, .name = input.name};
  return name_errors(input.path, [&] { return bake_window(task, window, target); });
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
       (one ? " file is no height by its name: " : " files are no heights by their names: ") +
       listed.left_out.front().filename().string() + (one ? "" : ", …") +
       "; left out, unless --pattern chooses it");
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

void bake(BakeCommand& command) {
  apply_run_options(command.run);
  parse_bake_options(command);
  const BakeInputs listed = list_bake_inputs(command.inputs, command.pattern);
  const std::vector<BakeInput>& inputs = listed.inputs;
  tell_left_out(listed);
  tell_unused_reliefs(command, listed);
  if (!command.match.empty() && inputs.size() > 1)
    throw UsageError("match", "",
                     "is of one material, and there are " + std::to_string(inputs.size()) + " maps");
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

void add_texture_options(CLI::App& app, BakeCommand& command) {
  BakeOptions& options = command.options;
  add_pack_options(app, command.pack);
  app.add_flag("--dither", options.dither, "blue noise instead of rounding, for --depth 8");
}

void add_map_content_options(CLI::App& app, BakeCommand& command) {
  BakeOptions& options = command.options;
  app.add_option("--maps", command.maps, "what to bake, separated by commas (ao,normal,bent-normal)")
      ->type_name("MAP,…");
  app.add_option_function<std::string>(
         "--ao", [&options](const std::string& text) { options.uniform_ao = text == "uniform"; },
         "cosine: as light falls on the surface (default); uniform: plain share of solid angle")
      ->check(CLI::IsMember({"cosine", "uniform"}));
  app.add_option(
         "--albedo", command.albedo,
         "of multibounce: a number or R,G,B (linear), '#RRGGBB' (sRGB), or an image of the map's size "
         "(0.5)")
      ->type_name("R|R,G,B|#RRGGBB|FILE");
  add_light_options(app, command.light);
  app.add_option("--max-distance", command.max_distance,
                 "how far occluders count, in world units or percent of the width; not for multibounce, ao-n "
                 "(everywhere)")
      ->type_name("D|P%");
  app.add_option(
         "--falloff", command.falloff,
         "what is nearer than --max-distance occludes: wholly (none, default), or by 1 - d/D (linear), "
         "1 - sqrt(d/D) (sqrt), or by exp(-4 d/D), shifted to end at D (exponential)")
      ->check(CLI::IsMember(falloff_names()));
  app.add_option("--roughness", command.roughness,
                 "of specular-occlusion: GGX's alpha, above 0 and at most 1 (0.13)")
      ->type_name("R");
  app.add_option("--view", command.view,
                 "of specular-occlusion: whence it is seen, in degrees clockwise from north, which is up the "
                 "map, and above the horizontal (0,90)")
      ->type_name("AZIMUTH,ELEVATION");
  app.add_option("--normal-strength", options.normal_strength,
                 "slopes of the normal map times this: 1, the heights' own, or what looks better (1)");
  app.add_option("--detail-scale", command.detail_scale,
                 "of curvature and cavity: standard deviation of the Gaussian mean of the heights, in world "
                 "units or percent of the width (0.25%)")
      ->type_name("D|P%");
  app.add_option("--midlevel", options.midlevel,
                 "of displacement: where in the relief it is none, from 0, the lowest place, to 1 (0.5)");
  app.add_option_function<std::string>(
         "--displacement-unit",
         [&options](const std::string& text) {
           options.displacement_unit = text == "cm" ? DisplacementUnit::centimetre : DisplacementUnit::metre;
         },
         "m: Blender, Godot, glTF, Unity (default); cm: Unreal. World units are taken as metres")
      ->check(CLI::IsMember({"m", "cm"}));
  app.add_flag("--bent-length", options.bent_length, "keep the length of bent normals in alpha");
  app.add_option("--horizon-azimuths", options.horizon_azimuths, "azimuths of the horizon map, 1 to 360 (4)");
  app.add_option_function<std::string>(
         "--azimuth-convention",
         [&options](const std::string& text) { options.azimuth_convention = azimuth_convention_named(text); },
         "of the horizon map: north, clockwise from it (default of open maps), or math, from x toward y")
      ->check(CLI::IsMember({"north", "math"}));
  app.add_option_function<std::string>(
         "--below-horizontal",
         [&options](const std::string& text) { options.below = below_horizontal_named(text); },
         "what lies there where no surface is: sky (default), or ground, which does not shine; then A of a "
         "plane tilted by S is (1 + cos S)/2. Not for ao-n")
      ->check(CLI::IsMember({"sky", "ground"}));
}

std::string describe_maps() {
  std::string text = "Maps:\n";
  for (const MaterialMapName& entry : material_maps()) {
    const std::string name = entry.name;
    text += "  " + name + std::string(21 - name.size(), ' ') + entry.description + "\n";
  }
  return text + "h is the elevation of the horizon, V visibility of the sky; means are over azimuths.\n";
}

}  // namespace

void add_bake_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("bake", "Make material maps: ambient occlusion, bent normals, bounces, …");
  auto options = std::make_shared<BakeCommand>();
  command->add_option("MAP", options->inputs, "heightmaps, or folders of them")->required();
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  add_map_content_options(*command, *options);
  add_texture_options(*command, *options);
  add_load_options(*command, options->load);
  command
      ->add_option(
          "--reliefs", options->reliefs,
          "reliefs of maps by their names, in place of --relief: a file with lines of a name, a relief "
          "and perhaps a width (brick,5cm,1m)")
      ->type_name("FILE|NAME=H,…");
  auto* match = command
                    ->add_option("--match", options->match,
                                 "a normal or AO map that the material came with: the relief is the one at "
                                 "which the heights fit it best")
                    ->type_name("FILE");
  for (const char* other : {"--relief", "--height", "--reliefs"}) match->excludes(command->get_option(other));
  command->add_option("--error", options->options.error,
                      "RMSE wanted of the sky view factor, of the total, and of specular-occlusion (0.002)");
  command->add_option("--azimuths", options->options.azimuths,
                      "azimuths of the sky, an even number (chosen for --error)");
  command
      ->add_option_function<int>(
          "--out-of-core", [options](int side) { options->windows = side; },
          "window by window, of SIDE texels each (as many as memory holds), through files beside the "
          "results; "
          "what was stopped goes on where it was. By itself where memory does not hold a TIFF")
      ->expected(0, 1)
      ->default_val(0)
      ->type_name("SIDE");
  command->add_flag(
      "--sheet", options->sheet,
      "one more file, NAME_sheet.png: heights, ao, bent normals, bounces and a lit sphere, labelled");
  command
      ->add_option(
          "--window", options->window,
          "a part of the map alone, in texels from its upper left corner; what is around it is looked "
          "at all the same")
      ->type_name("COLUMN,ROW,WIDTH,HEIGHT");
  command->add_flag("--skip-existing", options->skip_existing,
                    "leave out maps that were baked as is asked for now, with all files still there");
  command
      ->add_option("--pattern", options->pattern,
                   "of folders, bake the files with such names (*_height.png), whatever they are called")
      ->type_name("GLOB");
  command->add_flag(
      "--report", options->report,
      "also write NAME_report.html of each map: one file for any browser, with pictures that zoom and "
      "flip, and the evidence");
  add_run_options(*command, options->run);
  add_json_option(*command, options->json);
  command->footer(
      describe_maps() + describe_presets() +
      "multibounce holds all bounces: albedo * multibounce is the colour under an even sky. Never give\n"
      "it to an engine that brightens AO again (multi-bounce or coloured AO), nor multiply it by\n"
      "ao: such an engine wants ao. docs/colour-and-bounces.md tells more.\n"
      "Each goes into NAME_map.png; NAME_bake.json says what they hold and what they err by.\n"
      "Examples:\n"
      "  heightlight bake brick.png -o maps --relief 0.05\n"
      "  heightlight bake rock.exr -o maps --maps ao,bent-normal,multibounce --albedo '#a0522d'\n"
      "  heightlight bake heights/ -o maps --maps ao --max-distance 5% --falloff linear "
      "--skip-existing\n"
      "  heightlight bake brick.png -o maps --pack R=ao,G=height --depth 8 --normal-y directx\n"
      "  heightlight bake rock.png -o maps --preset unreal --input roughness=rock_rough.png");
  command->callback([options] { bake(*options); });
}

}  // namespace heightlight
