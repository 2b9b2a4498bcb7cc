#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "base/progress.h"
#include "base/stopwatch.h"
#include "cli/commands.h"
#include "cli/fit_page.h"
#include "cli/fit_pictures.h"
#include "cli/fit_print.h"
#include "cli/map_options.h"
#include "cli/memory_promise.h"
#include "cli/plots.h"
#include "cli/report_facts.h"
#include "cli/tell.h"
#include "cli/terminal_watch.h"
#include "cli/user_form_options.h"
#include "cli/warnings.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "files/staged_output.h"
#include "fit/fit_study.h"
#include "heightlight/error.h"
#include "heightlight/shaders.h"
#include "plot/ratio_plots.h"

namespace heightlight {
namespace {

struct FitOptions {
  std::vector<std::filesystem::path> curves;
  std::filesystem::path folder;
  int bootstrap = 200;
  UserFormOptions forms;
  RunOptions run;
  bool report = false;
};

/// `inputs` gets the file of each.
std::vector<JudgedMap> read_maps(const FitOptions& options, std::vector<std::filesystem::path>& inputs) {
  std::vector<JudgedMap> maps;
  std::size_t without_run = 0;
  const Watch watch = terminal_watch(options.run.quiet);
  Progress progress("reading", static_cast<std::int64_t>(options.curves.size()), watch);
  for (const std::filesystem::path& path : options.curves) {
    progress.throw_if_stopped();
    std::vector<JudgedMap> read =
        keep_promise(options.run, [&] { return read_judged_maps(path, options.run.memory); });
    for (JudgedMap& map : read) {
      without_run += map.expected_seen ? 0 : 1;
      maps.push_back(std::move(map));
      inputs.push_back(path);
    }
    progress.add(1);
  }
  if (without_run > 0 && without_run < maps.size())
    tell("warning: " + std::to_string(without_run) + " of " + std::to_string(maps.size()) +
         " maps have no summary.json beside their curves; forms that need it are not judged on these maps");
  return maps;
}

/// The forms of the list with the constants fitted here, then the user's.
std::string shader_of_report(const FitReport& report, const std::vector<UserForm>& own,
                             ShaderLanguage language) {
  std::vector<ShaderFunction> functions;
  for (const UserForm& form : own) {
    const FittedFamily* fitted = find_family(report, form.name);
    std::vector<double> constants;
    if (fitted) {
      const auto* first = fitted->fit.parameters.data();
      constants.assign(first, first + form.expression.constants.size());
    }
    for (ShaderFunction& function : user_form_functions(form, constants))
      functions.push_back(std::move(function));
  }
  return shader_text(language, shader_constants(report), functions);
}

const JudgedForm* find_judged(const std::vector<JudgedForm>& forms, const UserForm& wanted) {
  for (const JudgedForm& form : forms) {
    const bool fitted = !wanted.expression.constants.empty();
    if (form.name == wanted.name + (fitted ? "_refit" : "")) return &form;
  }
  return nullptr;
}

/// A user who gave a form wants it judged, or to know why not, and where it has poles.
void check_judged(const FitReport& report, const UserForm& form) {
  const JudgedForm* by_texel = find_judged(report.trial.per_texel, form);
  const JudgedForm* judged = by_texel ? by_texel : find_judged(report.trial.per_bin, form);
  if (!judged && report.trial.per_texel.empty() &&
      (wants_both_kinds(form) || user_form_extra(form) != ExtraInput::none))
    throw UsageError("form", form.name,
                     "depends on n, or on both alpha and A, but no map has the bounces of every texel beside "
                     "its curves (simulate --save-bounces)");
  if (!judged) throw UsageError("form", form.name, "has no finite value on any of the maps");
  if (judged->outside_share > 0)
    tell(fmt::format("warning: form {} has no finite value on {:.2g} % of the {}", form.name,
                     100 * judged->outside_share, by_texel ? "texels" : "bins"));
}

void draw_plots(StagedFolder& folder, const FitReport& report, Plots& plots) {
  const auto draw = [&](const std::string& name, const auto& plot) {
    plots.draw(folder, {name + ".svg", name + ".png"}, [&](const auto& paths) { plot(paths[0], paths[1]); });
  };
  draw("fitted", [&](const auto& svg, const auto& png) { plot_fitted(svg, png, fitted_panels(report)); });
  const bool by_texel = !report.trial.per_texel.empty();
  const std::vector<JudgedForm>& judged = by_texel ? report.trial.per_texel : report.trial.per_bin;
  draw("errors", [&](const auto& svg, const auto& png) { plot_errors(svg, png, judged); });
  draw("bounces",
       [&](const auto& svg, const auto& png) { plot_bounce_fits(svg, png, bounce_fit_input(report)); });
  draw("ratios", [&](const auto& svg, const auto& png) { plot_ratios(svg, png, report.ratios); });
  draw("saturation",
       [&](const auto& svg, const auto& png) { plot_saturation(svg, png, saturation_table(report)); });
  draw("cubic", [&](const auto& svg, const auto& png) { plot_cubics(svg, png, cubic_panel(report)); });
}

std::vector<std::string> fit_result_names() {
  std::vector<std::string> names{"models.json", "models.csv",  "ratios.csv",
                                 "models.glsl", "models.hlsl", kReportFile};
  for (const std::string plot : {"fitted", "errors", "bounces", "ratios", "saturation", "cubic"}) {
    names.push_back(plot + ".svg");
    names.push_back(plot + ".png");
  }
  return names;
}

void fit(FitOptions& options) {
  const Stopwatch watch;
  apply_run_options(options.run);
  check_bootstrap(options.bootstrap);
  const std::vector<UserForm> own = read_user_forms(options.forms.forms, options.forms.file);
  std::vector<std::filesystem::path> inputs = options.curves;
  inputs.push_back(options.forms.file);
  StagedFolder folder(options.folder, inputs, fit_result_names(), {.file = "models.json"});
  Plots plots;
  std::vector<std::filesystem::path> curves;
  std::vector<JudgedMap> maps = read_maps(options, curves);
  FitReport report = fit_maps(
      std::move(maps), own,
      {.draws = options.bootstrap, .seed = options.run.seed, .watch = terminal_watch(options.run.quiet)});
  report.inputs = std::move(curves);
  for (const UserForm& form : own) check_judged(report, form);

  write_bytes(folder.file("models.csv"), report_csv(report));
  write_bytes(folder.file("ratios.csv"), ratios_csv(report));
  write_bytes(folder.file("models.glsl"), shader_of_report(report, own, ShaderLanguage::glsl));
  write_bytes(folder.file("models.hlsl"), shader_of_report(report, own, ShaderLanguage::hlsl));
  draw_plots(folder, report, plots);
  if (options.report) write_fit_page(folder.file(kReportFile), report, options.curves, watch.elapsed().wall);
  report.files = folder.written();
  write_bytes(folder.file("models.json"), report_json(report));
  const std::vector<std::string> removed = folder.commit();
  if (!options.run.quiet) {
    report_removed(removed);
    print_report(report);
    fmt::print("results in {}\n", printable(options.folder));
  }
  plots.check();
}

}  // namespace

void add_fit_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "fit",
      "Fit closed forms of the total irradiance, and judge them on maps that were not used in the fit");
  auto options = std::make_shared<FitOptions>();
  command
      ->add_option("CURVES", options->curves,
                   "one or more files: curves.csv of simulate or dataset.csv of dataset")
      ->required();
  command->add_option("-o,--output", options->folder, "folder for the results")->type_name("DIR")->required();
  add_user_form_options(*command, options->forms);
  command->add_option(
      "--bootstrap", options->bootstrap,
      "number of bootstrap draws for the confidence intervals of parameters, 20 to 100000 (default 200)");
  add_report_option(*command, options->report);
  add_run_options(*command, options->run);
  command->footer(
      "If simulate --save-bounces wrote every bounce beside a curves.csv, forms are also judged texel by "
      "texel.\n"
      "Maps whose names are the same up to the first _ - or ., without digits, count as one material. Forms "
      "are\n"
      "judged on each material after a fit to the other materials only.\n"
      "Writes models.json, models.csv, models.glsl, models.hlsl, ratios.csv (is tau one number?), and\n"
      "plots: fitted, errors, bounces, ratios, saturation, cubic.\n"
      "Examples:\n"
      "  heightlight fit wall/curves.csv -o models\n"
      "  heightlight fit runs/*/curves.csv -o models\n"
      "  heightlight fit study/dataset.csv -o models\n"
      "  heightlight fit runs/*/curves.csv -o models --form 'mine = A/(1 - rho*(1 - A)^k)'");
  command->callback([options] { fit(*options); });
}

}  // namespace heightlight
