#include <cstdio>
#include <memory>

#include "cli/commands.h"
#include "cli/simulation.h"
#include "core/byte_size.h"

namespace heightlight {
namespace {

void report(const SimulateOptions& options, const Simulation& simulation) {
  if (options.run.quiet) return;
  const StepTimes& s = simulation.seconds;
  std::printf("%s: %d x %d texels, %llu links (%s) in %.1f s\n", options.map.path.c_str(), simulation.width,
              simulation.height, static_cast<unsigned long long>(simulation.links),
              format_byte_size(simulation.link_bytes).c_str(), s.total);
  std::printf("visibility %.1f s, bounces %.1f s, curves %.1f s, output %.1f s\n", s.visibility, s.bounces,
              s.curves, s.output);
  if (simulation.check) {
    std::printf("RMSE against exact walks: %.2g of the sky view factor, %.2g of the total\n",
                simulation.check->sky_rmse, simulation.check->total_rmse);
  } else if (simulation.rmse_estimate) {
    std::printf("RMSE of the sky view factor about %.2g\n", *simulation.rmse_estimate);
  }
  std::printf(
      "energy: sum of all bounces is 1 within %.1g; after %d of them %.2g is left on average (%.2g at "
      "most)\n",
      simulation.energy.sum_max_error, options.bounces, simulation.energy.tail_mean,
      simulation.energy.tail_max);
  std::printf("results in %s\n", options.folder.c_str());
}

}  // namespace

void add_simulate_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("simulate", "AO, sky view factor, links, bounces, curves and plots of a heightmap");
  auto options = std::make_shared<SimulateOptions>();
  add_map_options(*command, options->map);
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  add_visibility_options(*command, options->visibility);
  command->add_option("--bounces", options->bounces, "bounces to keep apart; the rest is the tail (20)");
  command
      ->add_option("--albedo", options->albedo,
                   "of the total: a number, R,G,B, or an image of the map's size (0.5)")
      ->type_name("R|R,G,B|FILE");
  command->add_option("--bins", options->bins, "AO bins of the curves (100)");
  command->add_flag("--save-bounces", options->save_bounces,
                    "also write irradiance_00.exr, irradiance_01.exr, …");
  add_run_options(*command, options->run);
  command->footer(
      "Examples:\n"
      "  heightlight simulate brick.png -o brick                         a tiling material, relief a tenth "
      "of its width\n"
      "  heightlight simulate rock.exr -o rock --relief 0.3 --albedo 0.6,0.4,0.3\n"
      "  heightlight simulate dem.tif -o dem --texel 50 --boundary open  terrain in metres");
  command->callback([options] {
    apply_run_options(options->run);
    report(*options, simulate_map(*options));
  });
}

}  // namespace heightlight
