#include <fmt/core.h>

#include <memory>

#include "cli/commands.h"
#include "cli/map_options.h"
#include "cli/terminal_watch.h"
#include "files/printable.h"
#include "files/specular_table_file.h"
#include "files/staged_output.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

struct TableOptions {
  std::filesystem::path file;
  int side = 16;
  RunOptions run;
};

void run_specular_table(TableOptions& options) {
  constexpr int kArguments = 10000;
  if (options.file.extension() != ".ktx")
    throw UsageError(options.file.string() + ": the output must be a .ktx");
  apply_run_options(options.run);
  const Watch watch = terminal_watch(options.run.quiet);
  StagedFile file(options.file);
  const SpecularTable table = make_specular_table(options.side, watch);
  write_specular_table(file.path(), table);
  const TableError error = judge_specular_table(table, kArguments, options.run.seed, watch);
  file.commit();
  if (options.run.quiet) return;
  fmt::print(
      "{}: {} bytes of values; against the integral at {} random arguments RMSE {:.4f}, at most {:.3f}\n",
      printable(options.file), table.values.size(), kArguments, error.rmse, error.largest);
}

}  // namespace

void add_specular_table_command(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("specular-table", "Make the table of specular occlusion that GTSO looks up");
  auto options = std::make_shared<TableOptions>();
  command->add_option("-o,--output", options->file, "file to write: a .ktx with a 3D texture of 8 bits")
      ->required()
      ->type_name("FILE");
  command->add_option(
      "--side", options->side,
      "number of values along each of the four axes, a multiple of 4 from 4 to 64 (default 16)");
  add_run_options(*command, options->run);
  command->footer(
      "The table holds the fraction of a glossy lobe (GGX, reflectance 0.04) that lies in a cone of open\n"
      "directions, by the half-angle of the cone, the angle between its axis and the mirrored view, the\n"
      "roughness, and the angle of the view. The metadata of the texture describe its layout; heightlight "
      "bake\n"
      "writes the shader that looks it up.\n"
      "Example:\n"
      "  heightlight specular-table -o gtso.ktx --side 32");
  command->callback([options] { run_specular_table(*options); });
}

}  // namespace heightlight
