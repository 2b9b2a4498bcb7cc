#include "terrain/terrain_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>

#include "comparison/report_answer.h"
#include "files/output_file.h"
#include "heightlight/terrain_forms.h"

namespace heightlight {
namespace {

void begin_table(std::FILE* file, const std::vector<std::string>& heads) {
  for (const std::string& head : heads) fmt::print(file, "| {} ", head);
  fmt::print(file, "|\n");
  for (std::size_t i = 0; i < heads.size(); ++i) fmt::print(file, "|---");
  fmt::print(file, "|\n");
}

void write_map(std::FILE* file, const TerrainReportInput& input) {
  const Surface& surface = input.surface;
  fmt::print(file, "# {}: formulas and algorithms for terrain\n\n", as_markdown(input.map_name));
  fmt::print(file, "{} × {} texels of {:g} × {:g}, relief {:g}, boundary open.\n\n", surface.width(),
             surface.height(), surface.map.spacing.x, surface.map.spacing.y, relief(surface.map));
  for (const Warning& warning : input.warnings)
    fmt::print(file, "* Warning: {}\n", as_markdown(warning.message));
  if (!input.warnings.empty()) std::fputc('\n', file);
}

void write_truth(std::FILE* file, const TerrainStudy& study) {
  const TerrainTrial& trial = study.trial;
  const auto degrees = [](double radians) { return radians * 180 / std::numbers::pi; };
  const Sun& sun = study.options.sun;
  fmt::print(file,
             "## What terrain reflects\n\nThe truth is light transport to convergence, all bounces, of the "
             "direct irradiance that the formulas are given too: of an even sky, which shines from below the "
             "horizontal as well where the map ends, or of the sun alone, {:.4g}° from north and {:.4g}° "
             "high. E/π; the sun's in units of a plane that faces it. All texels count, also those at the "
             "border, which see less terrain than they would. Mean A {:.4f}; with what lies below the "
             "horizontal dark {:.4f}.\n\n",
             degrees(std::numbers::pi / 2 - sun.azimuth_rad), degrees(sun.elevation_rad), trial.mean_sky,
             trial.mean_upper_sky);
  begin_table(file, {"light", "albedo", "direct, mean", "reflected, mean", "error of the truth, RMSE"});
  for (const TrialLight& light : trial.lights) {
    for (std::size_t a = 0; a < study.options.albedos.size(); ++a) {
      const double albedo = study.options.albedos[a];
      const auto row = std::find_if(trial.rows.begin(), trial.rows.end(), [&](const TerrainFormRow& one) {
        return one.light == light.name && one.albedo == albedo;
      });
      if (row == trial.rows.end()) continue;
      fmt::print(file, "| {} | {:g} | {:.4f} | {:.4f} | {} |\n", light.name, albedo, light.mean_direct,
                 row->reflected,
                 a < light.evidence.total_checks.size()
                     ? fmt::format("{:.2g}", light.evidence.total_checks[a].total_rmse)
                     : "");
    }
  }
  std::fputc('\n', file);
}

void write_formulas(std::FILE* file) {
  fmt::print(
      file,
      "Window means (w) are plain ones over a square; those that ours take, D and A, are weighted by V "
      "over the cosine of the slope. L is a level open plain's direct irradiance, S the slope, V = 1 − "
      "A.\n\n");
  begin_table(file, {"form", "E", "source"});
  for (const TerrainForm& form : terrain_forms())
    fmt::print(file, "| {} | {} | {} |\n", form.name, as_markdown(form.description),
               as_markdown(form.source));
  std::fputc('\n', file);
}

const TerrainFormRow* find_form_row(const TerrainStudy& study, const TerrainFormRow& key) {
  for (const TerrainFormRow& row : study.trial.rows) {
    if (row.light == key.light && row.albedo == key.albedo && row.form == key.form &&
        (row.window == 0 || row.window == key.window))
      return &row;
  }
  return nullptr;
}

/// Radii of windows that were tried, world units.
std::vector<double> windows_of(const TerrainStudy& study) {
  std::vector<double> windows;
  for (const TerrainFormRow& row : study.trial.rows) {
    if (row.window > 0 && std::find(windows.begin(), windows.end(), row.window) == windows.end())
      windows.push_back(row.window);
  }
  return windows;
}

void write_forms(std::FILE* file, const TerrainStudy& study, const std::string& light, double window) {
  fmt::print(
      file,
      "### Under the {}, windows of radius {:g}\n\nRMSE; bias; 95 % of the texels err by no more; RMSE "
      "in percent of the mean reflected light.\n\n",
      light, window);
  std::vector<std::string> heads{"form"};
  for (const double albedo : study.options.albedos) heads.push_back(fmt::format("albedo {:g}", albedo));
  begin_table(file, heads);
  for (const TerrainForm& form : terrain_forms()) {
    if (form.even_sky_only && light != "sky") continue;
    fmt::print(file, "| {} |", form.name);
    for (const double albedo : study.options.albedos) {
      const TerrainFormRow* row =
          find_form_row(study, {.light = light, .albedo = albedo, .form = form.name, .window = window});
      if (row)
        fmt::print(file, " {:.4f}; {:+.4f}; {:.4f}; {:.0f} %", row->error.rmse, row->error.bias,
                   row->error.p95, 100 * row->relative_rmse());
      fmt::print(file, " |");
    }
    std::fputc('\n', file);
  }
  std::fputc('\n', file);
}

void write_windows(std::FILE* file, const TerrainStudy& study) {
  const double albedo = study.options.albedos.back();
  const std::vector<double> windows = windows_of(study);
  fmt::print(file, "### What the window's radius does: RMSE at albedo {:g}\n\n", albedo);
  std::vector<std::string> heads{"light", "form"};
  for (const double window : windows) heads.push_back(fmt::format("{:g}", window));
  begin_table(file, heads);
  for (const TrialLight& light : study.trial.lights) {
    for (const TerrainForm& form : terrain_forms()) {
      if (!form.wants_window) continue;
      fmt::print(file, "| {} | {} |", light.name, form.name);
      for (const double window : windows) {
        const TerrainFormRow* row = find_form_row(
            study, {.light = light.name, .albedo = albedo, .form = form.name, .window = window});
        fmt::print(file, " {} |", row ? fmt::format("{:.4f}", row->error.rmse) : "");
      }
      std::fputc('\n', file);
    }
  }
  std::fputc('\n', file);
}

/// Errors under a light at the last albedo: the literature's average albedo, and the form that errs least.
void write_best_form(std::FILE* file, const TerrainStudy& study, const std::string& light, double window) {
  const double albedo = study.options.albedos.back();
  const auto row_of = [&](const std::string& form) {
    return find_form_row(study, {.light = light, .albedo = albedo, .form = form, .window = window});
  };
  const TerrainFormRow* best = nullptr;
  for (const TerrainForm& form : terrain_forms()) {
    const TerrainFormRow* row = row_of(form.name);
    if (row && (!best || row->error.rmse < best->error.rmse)) best = row;
  }
  const TerrainFormRow* average = row_of("average_albedo");
  if (!best || !average) return;
  fmt::print(
      file,
      "* **What do formulas make of what terrain reflects under the {}?** At albedo {:g} it is {:.4f} in "
      "the mean. {} errs least, RMSE {:.4f}; Dozier and Frew's average albedo by {:.4f} with C\\_t, "
      "by {:.4f} with 1 − A.\n",
      light, albedo, best->reflected, as_markdown(best->form), best->error.rmse, average->error.rmse,
      row_of("average_albedo_seen")->error.rmse);
}

/// What of a method's row answers.
std::string cost_and_error(const TerrainMethodRow& row) {
  return fmt::format("RMSE {:.4f}, bias {:+.4f}, {:.2g} core-seconds per megatexel", row.error.rmse,
                     row.error.bias, row.per_megatexel);
}

/// Of one quantity in the usual way, by as many walks, and by a walk planned for an error.
void write_usual_cost(std::FILE* file, const TerrainStudy& study, const TerrainQuantity& quantity) {
  constexpr int kUsualAzimuths = 16;
  constexpr int kUsualCells = 100;
  fmt::print(file, "* **What do {} azimuths and {} cells of reach cost, of {}?**", kUsualAzimuths,
             kUsualCells, as_markdown(name_of(quantity)));
  const TerrainMethodRow* planned = nullptr;
  for (const TerrainMethodRow& row : study.methods) {
    if (row.quantity != quantity) continue;
    if (row.error_wanted > 0) planned = &row;  // the last is for the smallest error
    const bool is_march = row.method == kRayMarchMethod || row.method == kCellMarchMethod;
    const bool is_usual = row.azimuths == kUsualAzimuths && row.cells == (is_march ? kUsualCells : 0);
    if (is_usual) fmt::print(file, " {}: {}.", row.method, cost_and_error(row));
  }
  if (planned)
    fmt::print(file, " {}, {}: {}.", planned->method, parameters_of(*planned), cost_and_error(*planned));
  std::fputc('\n', file);
}

void write_methods(std::FILE* file, const TerrainStudy& study) {
  fmt::print(
      file,
      "## What sky view factors cost\n\nErrors on {} receivers against exact horizons along {} "
      "azimuths. Core-seconds per megatexel, each quantity found alone. Nearest-cell marching steps "
      "by a cell along the ray, and takes the height of the nearest cell and the way along the ray, or "
      "the distance of the cell's middle; its sums over azimuths take most of its time on slopes. Exact "
      "horizons are timed on the receivers. Horizon walks choose how closely they look, for an error of "
      "{:g} where the azimuths are given, and planned walks how many azimuths, too; that takes its time on "
      "small maps.\n\n",
      study.receivers, kTruthAzimuths, kErrorOfGivenAzimuths);
  for (const TerrainQuantity& quantity : terrain_quantities()) {
    fmt::print(file, "### {}: {}\n\n", name_of(quantity), as_markdown(formula_of(quantity)));
    begin_table(file, {"method", "parameters", "core-seconds per megatexel", "RMSE", "bias", "p95"});
    for (const TerrainMethodRow& row : study.methods) {
      if (row.quantity != quantity) continue;
      fmt::print(file, "| {} | {} | {:.3g} | {:.5f} | {:+.5f} | {:.5f} |\n", row.method, parameters_of(row),
                 row.per_megatexel, row.error.rmse, row.error.bias, row.error.p95);
    }
    std::fputc('\n', file);
  }
}

}  // namespace

void write_terrain_report(const std::filesystem::path& path, const TerrainReportInput& input) {
  write_file(path, [&](std::FILE* file) {
    const TerrainStudy& study = input.study;
    const std::vector<double> windows = windows_of(study);
    const double window = windows[windows.size() / 2];
    write_map(file, input);
    for (const TrialLight& light : study.trial.lights) write_best_form(file, study, light.name, window);
    for (const BelowHorizontal below : {BelowHorizontal::sky, BelowHorizontal::ground})
      write_usual_cost(file, study, {.definition = SkyDefinition::svf_tilted, .below = below});
    std::fputc('\n', file);
    write_truth(file, study);
    write_formulas(file);
    for (const TrialLight& light : study.trial.lights) write_forms(file, study, light.name, window);
    write_windows(file, study);
    write_methods(file, study);
  });
}

}  // namespace heightlight
