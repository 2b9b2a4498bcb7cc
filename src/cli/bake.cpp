#include "bake/bake.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <sstream>
#include <system_error>

#include "base/progress.h"
#include "cli/albedo.h"
#include "cli/bake_inputs.h"
#include "cli/commands.h"
#include "cli/map_options.h"
#include "cli/name_errors.h"
#include "cli/terminal_watch.h"
#include "cli/user_message.h"
#include "files/staged_output.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// What `heightlight bake` was asked for, as text until it is read.
struct BakeCommand {
  std::vector<std::filesystem::path> inputs;
  LoadOptions load;
  RunOptions run;
  std::filesystem::path folder;
  BakeOptions options;
  std::string maps;
  std::string packed;
  std::string albedo = "0.5";
  std::string max_distance;
  std::string falloff = "none";
  std::string depth;
  bool skip_existing = false;
};

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

MaterialMap parse_map(const std::string& option, const std::string& name) {
  std::string known;
  for (const MaterialMapName& entry : material_maps()) {
    if (name == entry.name) return entry.map;
    known += std::string(known.empty() ? "" : ", ") + entry.name;
  }
  throw UsageError(option, "", "'" + name + "' is no map (known: " + known + ")");
}

/// "ao", "bent-normal.x", "sh.8", or a constant in [0, 1].
PackedChannel parse_source(const std::string& text) {
  char* end = nullptr;
  const double constant = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0') {
    if (!(constant >= 0 && constant <= 1)) throw UsageError("pack", "", text + " is not in [0, 1]");
    return {.map = std::nullopt, .constant = constant};
  }
  const std::size_t point = text.find('.');
  PackedChannel channel{.map = parse_map("pack", text.substr(0, point))};
  if (point == std::string::npos) return channel;
  const std::string component = text.substr(point + 1);
  const std::size_t letter = std::string("xyzwrgba").find(component);
  if (component.size() == 1 && letter != std::string::npos) {
    channel.component = static_cast<int>(letter % 4);
  } else if (!component.empty() && component.size() <= 3 &&
             component.find_first_not_of("0123456789") == std::string::npos) {
    channel.component = std::stoi(component);
  } else {
    throw UsageError("pack", "",
                     "'" + component + "' names no component (x, y, z, w, r, g, b, a, or a number from 0)");
  }
  return channel;
}

/// "R=ao,G=multibounce,B=0": channels without a source before one with are 0.
std::vector<PackedChannel> parse_packed(const std::string& text) {
  const std::string letters = "RGBA";
  std::vector<std::optional<PackedChannel>> given(4);
  std::size_t count = 0;
  for (const std::string& part : split_at_commas(text)) {
    const std::size_t channel = part.size() > 2 && part[1] == '=' ? letters.find(part[0]) : std::string::npos;
    if (channel == std::string::npos || given[channel]) {
      throw UsageError("pack", text, "write it like R=ao,G=multibounce,B=normal.z, each of R, G, B, A once");
    }
    given[channel] = parse_source(part.substr(2));
    count = std::max(count, channel + 1);
  }
  if (count == 2) count = 3;  // image viewers know no two channels
  std::vector<PackedChannel> packed;
  for (std::size_t i = 0; i < count; ++i) packed.push_back(given[i].value_or(PackedChannel{}));
  return packed;
}

/// "0.05", or "5%" of the map's width.
double parse_distance(const std::string& text, const Heightmap& map) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  if (end == text.c_str() || (!unit.empty() && unit != "%")) {
    throw UsageError("max_distance", text, "write a length in world units, or a share of the width (5%)");
  }
  return unit.empty() ? value : value / 100 * map.spacing.x * map.height.width;
}

void parse_depth(const std::string& text, BakeOptions& options) {
  if (text.empty()) {
    options.depth = options.format == TextureFormat::exr ? TextureDepth::real : TextureDepth::uint16;
  } else {
    options.depth = text == "8"      ? TextureDepth::uint8
                    : text == "16"   ? TextureDepth::uint16
                    : text == "half" ? TextureDepth::half
                                     : TextureDepth::real;
  }
}

/// All that does not depend on a map.
void parse_options(BakeCommand& command) {
  BakeOptions& options = command.options;
  for (const std::string& name : split_at_commas(command.maps)) {
    options.maps.push_back(parse_map("maps", name));
  }
  options.packed = parse_packed(command.packed);
  if (options.maps.empty() && options.packed.empty()) {
    options.maps = {MaterialMap::ao, MaterialMap::normal, MaterialMap::bent_normal};
  }
  parse_depth(command.depth, options);
  options.memory = command.run.memory;
  options.seed = command.run.seed;
  if (command.falloff != "none" && command.max_distance.empty()) {
    throw UsageError("falloff", "", "needs --max-distance, where it ends");
  }
  BakeOptions any_albedo = options;  // how many channels it has, a file may have to tell
  any_albedo.albedo.constant.resize(3);
  check_bake_options(any_albedo);
}

/// All files that a batch reads. An albedo that is a number names no file.
std::vector<std::filesystem::path> input_files(const BakeCommand& command,
                                               const std::vector<BakeInput>& inputs) {
  std::vector<std::filesystem::path> files{command.albedo};
  for (const BakeInput& input : inputs) files.push_back(input.path);
  return files;
}

/// Before anything is baked: no map's files replace any map.
void check_batch(const BakeCommand& command, const std::vector<BakeInput>& inputs) {
  const std::vector<std::filesystem::path> files = input_files(command, inputs);
  for (const BakeInput& input : inputs) {
    for (const std::string& name : baked_files(input.name, command.options)) {
      check_inputs_stay(files, command.folder / name);
    }
  }
}

/// Of one map. Returns its warnings.
std::vector<std::string> bake_file(const BakeCommand& command, const BakeInput& input, bool quiet) {
  BakeOptions options = command.options;
  options.watch = terminal_watch(quiet);
  LoadedHeightmap loaded = load_heightmap(input.path, command.load, command.run.memory);
  options.albedo = read_albedo(command.albedo, loaded.map, command.run.memory);
  if (!command.max_distance.empty()) {
    const Falloff falloff = command.falloff == "linear" ? Falloff::linear
                            : command.falloff == "sqrt" ? Falloff::root
                                                        : Falloff::none;
    options.reach = Reach{.distance = parse_distance(command.max_distance, loaded.map), .falloff = falloff};
  }
  const std::vector<std::filesystem::path> inputs{input.path, command.albedo};  // a number names no file
  return name_errors(input.path, [&] {
    return bake_material(std::move(loaded), inputs, options, command.folder, input.name);
  });
}

bool is_baked(const BakeCommand& command, const BakeInput& input) {
  const std::vector<std::string> files = baked_files(input.name, command.options);
  return std::all_of(files.begin(), files.end(), [&](const std::string& file) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(command.folder / file, ignored);
  });
}

/// How a batch went.
struct Tally {
  std::size_t baked = 0;
  std::size_t skipped = 0;
  std::vector<std::string> faults;  ///< one line each
};

void bake_one(const BakeCommand& command, const BakeInput& input, bool only_one, Tally& tally) {
  if (command.skip_existing && is_baked(command, input)) {
    ++tally.skipped;
    return;
  }
  const std::vector<std::string> warnings = bake_file(command, input, command.run.quiet || !only_one);
  ++tally.baked;
  if (command.run.quiet) return;
  for (const std::string& warning : warnings) {
    fmt::print(stderr, "heightlight: warning: {}: {}\n", input.path.string(), warning);
  }
}

void report(const BakeCommand& command, const Tally& tally) {
  if (command.run.quiet) return;
  fmt::print("{} baked, {} skipped, {} failed; results in {}\n", tally.baked, tally.skipped,
             tally.faults.size(), command.folder.string());
}

void bake(BakeCommand& command) {
  apply_run_options(command.run);
  parse_options(command);
  const std::vector<BakeInput> inputs = list_bake_inputs(command.inputs);
  check_batch(command, inputs);
  const bool only_one = inputs.size() == 1;
  Tally tally;
  {
    const Watch watch = terminal_watch(command.run.quiet || only_one);
    Progress progress("bake", static_cast<std::int64_t>(inputs.size()), watch);
    for (const BakeInput& input : inputs) {
      try {
        bake_one(command, input, only_one, tally);
      } catch (const Cancelled&) {
        throw;
      } catch (const Error& error) {
        if (only_one) throw;
        tally.faults.push_back(user_message(error));
      }
      progress.add(1);
    }
  }
  report(command, tally);
  if (tally.faults.empty()) return;
  for (const std::string& fault : tally.faults) fmt::print(stderr, "heightlight: {}\n", fault);
  throw Error(std::to_string(tally.faults.size()) + " of " + std::to_string(inputs.size()) +
              " maps could not be baked");
}

void add_texture_options(CLI::App& app, BakeCommand& command) {
  BakeOptions& options = command.options;
  app.add_option("--format", options.format, "png (default), exr or tif")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, TextureFormat>{
              {"png", TextureFormat::png}, {"exr", TextureFormat::exr}, {"tif", TextureFormat::tif}},
          CLI::ignore_case))
      ->type_name("FORMAT");
  app.add_option("--depth", command.depth, "8, 16 (default), half or float (default of EXR)")
      ->check(CLI::IsMember({"8", "16", "half", "float"}));
  app.add_flag("--dither", options.dither, "blue noise instead of rounding, for --depth 8");
  app.add_option_function<std::string>(
         "--normal-y", [&options](const std::string& text) { options.y_down = text == "directx"; },
         "opengl: y up the picture (default); directx: down. Of all maps with directions")
      ->check(CLI::IsMember({"opengl", "directx"}));
  app.add_option("--pack", command.packed,
                 "one more file, NAME_packed, with channels of several maps: R=ao,G=height,B=normal.z …")
      ->type_name("R=MAP,…");
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
  app.add_option("--max-distance", command.max_distance,
                 "how far occluders count, in world units or percent of the width; not for multibounce, ao-n "
                 "(everywhere)")
      ->type_name("D|P%");
  app.add_option(
         "--falloff", command.falloff,
         "what is nearer than --max-distance occludes: wholly (none, default), or by 1 - d/D (linear), "
         "1 - sqrt(d/D) (sqrt)")
      ->check(CLI::IsMember({"none", "linear", "sqrt"}));
  app.add_flag("--bent-length", options.bent_length, "keep the length of bent normals in alpha");
  app.add_option("--horizon-azimuths", options.horizon_azimuths, "azimuths of the horizon map (4)");
}

std::string describe_maps() {
  std::string text = "Maps:\n";
  for (const MaterialMapName& entry : material_maps()) {
    const std::string name = entry.name;
    text += "  " + name + std::string(13 - name.size(), ' ') + entry.description + "\n";
  }
  return text;
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
  command->add_option("--error", options->options.error,
                      "RMSE wanted of the sky view factor and of the total (0.002)");
  command->add_option("--azimuths", options->options.azimuths,
                      "azimuths of the sky, an even number (chosen for --error)");
  command->add_flag("--skip-existing", options->skip_existing, "leave out maps whose files are all there");
  add_run_options(*command, options->run);
  command->footer(describe_maps() +
                  "Each goes into NAME_map.png; NAME_bake.json says what they hold and what they err by.\n"
                  "Examples:\n"
                  "  heightlight bake brick.png -o maps --relief 0.05\n"
                  "  heightlight bake rock.exr -o maps --maps ao,bent-normal,multibounce --albedo '#a0522d'\n"
                  "  heightlight bake heights/ -o maps --maps ao --max-distance 5% --falloff linear "
                  "--skip-existing\n"
                  "  heightlight bake brick.png -o maps --pack R=ao,G=height --depth 8 --normal-y directx");
  command->callback([options] { bake(*options); });
}

}  // namespace heightlight
