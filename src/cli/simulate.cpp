#include <fmt/core.h>

#include <memory>
#include <string>

#include "base/byte_size.h"
#include "base/stopwatch.h"
#include "cli/commands.h"
#include "cli/json_line.h"
#include "cli/reach_options.h"
#include "cli/report_facts.h"
#include "cli/simulation.h"
#include "cli/terminal_watch.h"
#include "cli/user_message.h"
#include "cli/warnings.h"
#include "files/printable.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

void report(const SimulateOptions& options, const Simulation& simulation) {
  tell_warnings(options.map.path, simulation.warnings);
  if (options.run.quiet) return;
  report_removed(simulation.removed);
  const StepTimes& own = simulation.seconds;
  const Evidence& evidence = simulation.evidence;
  const std::string links = evidence.links > 0 ? fmt::format(", {} links ({})", evidence.links,
                                                             format_byte_size(evidence.link_bytes))
                                               : "";
  fmt::print("{}: {} x {} texels{} in {:.1f} s\n", printable(options.map.path), simulation.width,
             simulation.height, links, own.total);
  fmt::print("visibility {:.1f} s, bounces {:.1f} s, curves {:.1f} s, output {:.1f} s\n",
             evidence.seconds.visibility, evidence.seconds.bounces, own.curves, own.output);
  if (!evidence.total_checks.empty()) {
    fmt::print("RMSE against exact walks: {:.2g} of the sky view factor, {:.2g} of the total\n",
               evidence.total_checks[0].sky_rmse, evidence.total_checks[0].total_rmse);
  } else if (evidence.sky_rmse) {
    fmt::print("RMSE of the sky view factor about {:.2g}\n", *evidence.sky_rmse);
  }
  fmt::print(
      "energy: sum of all bounces is 1 within {:.1g}; after {} of them {:.2g} is left on average ({:.2g} at "
      "most)\n",
      evidence.energy->sum_max_error, options.bounces, evidence.energy->tail_mean, evidence.energy->tail_max);
  fmt::print("results in {}\n", printable(options.folder));
}

/// What the maps err by, as far as that was found.
nlohmann::ordered_json errors_of(const Evidence& evidence) {
  nlohmann::ordered_json errors;
  if (!evidence.total_checks.empty()) {
    errors["sky_view_factor_rmse"] = evidence.total_checks[0].sky_rmse;
    errors["irradiance_total_rmse"] = evidence.total_checks[0].total_rmse;
  } else if (evidence.sky_rmse) {
    errors["sky_view_factor_rmse"] = *evidence.sky_rmse;
  }
  return errors;
}

void print_result(const SimulateOptions& options, const Simulation& simulation) {
  std::vector<std::string> names;
  for (const FileRecord& file : simulation.files) names.push_back(file.name);
  names.emplace_back("summary.json");
  print_json_line(MapLine{.map = options.map.path,
                          .status = "done",
                          .files = paths_in(options.folder, names),
                          .errors = errors_of(simulation.evidence),
                          .warnings = warning_texts(simulation.warnings),
                          .removed = simulation.removed,
                          .fault = {},
                          .seconds = simulation.seconds.total});
}

void simulate(SimulateOptions& options, bool json) {
  apply_run_options(options.run);
  check_simulate_options(options);
  check_load_options(options.map.load);
  check_albedo(options.albedo);
  Plots plots;
  Stopwatch watch;
  try {
    const Simulation simulation = simulate_map(options, plots, terminal_watch(options.run.quiet));
    if (json) {
      tell_warnings(options.map.path, simulation.warnings);
      print_result(options, simulation);
    } else {
      report(options, simulation);
    }
  } catch (const Error& error) {
    if (json) print_json_line(failed_line(options.map.path, user_message(error), watch.lap()));
    throw;
  }
  plots.check();
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "simulate", "Compute AO, sky view factor, links, bounces, curves and plots of a heightmap");
  auto options = std::make_shared<SimulateOptions>();
  add_map_options(*command, options->map);
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  add_visibility_options(*command, options->visibility);
  command->add_option("--bounces", options->bounces,
                      "number of bounces to store separately, 1 to 1000 (default 20); all later bounces "
                      "together are the tail");
  command
      ->add_option("--albedo", options->albedo,
                   "albedo for the total irradiance: a number, R,G,B, or an image of the size of the map "
                   "(default 0.5)")
      ->type_name("R|R,G,B|FILE");
  add_light_options(*command, options->light);
  command->add_option("--bins", options->bins, "number of AO bins of the curves, 1 to 10000 (default 100)");
  command->add_flag("--save-bounces", options->save_bounces,
                    "also write irradiance_00.exr, irradiance_01.exr, …");
  command->add_flag("--save-links", options->save_links,
                    "also write links.npz, the form factors as scipy.sparse.load_npz reads them; needs "
                    "--visibility rays or --error 0");
  command
      ->add_option("--obscurance", options->obscurance,
                   "also write obscurance.exr and ambient_transfer.exr (Umenhoffer et al. 2009, eqs. 5 and "
                   "6), for which occluders count up to this distance, in world units or percent of the "
                   "width; needs --visibility rays or --error 0")
      ->type_name("D|P%");
  command
      ->add_option("--falloff", options->falloff,
                   "how occluders lose weight with distance for --obscurance: none, linear, sqrt (default) "
                   "or exponential")
      ->check(CLI::IsMember(falloff_names()));
  add_report_option(*command, options->report);
  add_run_options(*command, options->run);
  auto json = std::make_shared<bool>(false);
  add_json_option(*command, *json);
  command->footer(
      "Examples:\n"
      "  heightlight simulate brick.png -o brick                         a tiling material, relief a tenth "
      "of its width\n"
      "  heightlight simulate rock.exr -o rock --relief 0.3 --albedo 0.6,0.4,0.3\n"
      "  heightlight simulate dem.tif -o dem                             terrain, spacing and heights from "
      "its file\n"
      "  heightlight simulate dem.tif -o dem --sun 135,30 --albedo 0.9   sun on snow");
  command->callback([options, json] { simulate(*options, *json); });
}

}  // namespace heightlight
