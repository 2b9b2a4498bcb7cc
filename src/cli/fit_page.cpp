#include "cli/fit_page.h"

#include <fmt/core.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cli/fit_pictures.h"
#include "cli/noted_command.h"
#include "cli/report_facts.h"
#include "files/image_file.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "report/page.h"

namespace heightlight {
namespace {

constexpr std::array<std::size_t, 5> kToldAlbedos{0, 2, 4, 6, 8};  // of judged_albedos: 0.1, 0.3 … 0.9
constexpr std::size_t kMiddle = 4;                                 // 0.5
constexpr std::size_t kMostInputs = 40;
constexpr std::size_t kShownForms = 6;

/// The forms as they are judged best: by texels, where maps have them.
const std::vector<JudgedForm>& best_judged(const FitReport& report) {
  return report.trial.per_texel.empty() ? report.trial.per_bin : report.trial.per_texel;
}

const char* judged_unit(const FitReport& report) {
  return report.trial.per_texel.empty() ? "bins' means" : "texels";
}

bool is_left_out(const FitReport& report) { return report.trial.materials > 1; }

std::string form_name(const JudgedForm& form) { return form.fitted ? form.name + " (fitted)" : form.name; }

std::vector<const JudgedForm*> sorted_forms(const FitReport& report, std::size_t albedo) {
  std::vector<const JudgedForm*> forms;
  for (const JudgedForm& form : best_judged(report)) forms.push_back(&form);
  std::stable_sort(forms.begin(), forms.end(), [albedo](const JudgedForm* a, const JudgedForm* b) {
    return a->errors[albedo].rms() < b->errors[albedo].rms();
  });
  return forms;
}

std::vector<PageFact> fit_asked(const FitReport& report) {
  return {{.name = "Maps", .value = std::to_string(report.maps.size())},
          {.name = "Materials", .value = std::to_string(report.trial.materials)},
          {.name = "Forms that were fitted", .value = std::to_string(report.families.size())},
          {.name = "Forms that were judged", .value = std::to_string(best_judged(report).size())}};
}

std::vector<PageFact> fit_reached(const FitReport& report) {
  std::vector<PageFact> facts;
  facts.push_back(
      {.name = "Judged on",
       .value = is_left_out(report)
                    ? "materials that the fit did not see, each in turn"
                    : "the very maps that were fitted to: errors elsewhere will be larger (give curves "
                      "of several materials)",
       .tone = is_left_out(report) ? Tone::good : Tone::bad});
  facts.push_back({.name = "Judged by", .value = judged_unit(report)});
  const std::vector<const JudgedForm*> forms = sorted_forms(report, kMiddle);
  const auto add_best = [&](const char* name, auto&& wanted) {
    const auto best = std::find_if(forms.begin(), forms.end(), wanted);
    if (best == forms.end()) return;
    facts.push_back({.name = name,
                     .value = fmt::format("{}: RMSE {:.4f}\n{}", form_name(**best),
                                          (*best)->errors[kMiddle].rms(), (*best)->formula)});
  };
  add_best("Best form at albedo 0.5", [](const JudgedForm*) { return true; });
  add_best("Best of those that AO alone is told",
           [](const JudgedForm* form) { return form->extra == ExtraInput::none && !form->both_kinds; });
  return facts;
}

std::vector<PageFact> fit_inputs(const std::vector<std::filesystem::path>& curves) {
  std::vector<PageFact> facts;
  for (std::size_t i = 0; i < std::min(curves.size(), kMostInputs); ++i)
    facts.push_back(input_fact(curves[i], sha256_of_file(curves[i])));
  if (curves.size() > kMostInputs)
    facts.push_back(
        {.name = fmt::format("and {} more", curves.size() - kMostInputs), .value = "models.json has all"});
  return facts;
}

/// A column of the table over its first.
PageCurve table_curve(const PlotTable& table, std::size_t column, const std::string& name) {
  PageCurve curve{.name = name};
  for (const std::vector<double>& row : table) curve.points.push_back({row[0], row[column]});
  return curve;
}

/// What was measured (dashed) and the form, at albedos 0 … 1, of which three are shown at first.
PageChart fitted_chart(const FittedPanel& panel) {
  const bool is_alpha = panel.kind == AoKind::ambient_occlusion;
  PageChart chart{.title = panel.title,
                  .about = "Dashed: means of what was measured, over all maps. Solid: the form.",
                  .x = is_alpha ? "ambient occlusion α" : "sky view factor A",
                  .y = "E/π, all bounces",
                  .ordered = true};
  for (std::size_t k = 0; k <= 10; ++k) {
    const std::string albedo = fmt::format("albedo {:g}", static_cast<double>(k) / 10);
    const bool shown = k == 2 || k == 5 || k == 8;
    PageCurve form = table_curve(panel.fitted, k + 1, albedo);
    PageCurve measured = table_curve(panel.measured, k + 1, albedo + ", measured");
    measured.dashed = true;
    for (PageCurve* curve : {&form, &measured}) {
      curve->shown = shown;
      curve->colour = k;
      chart.curves.push_back(std::move(*curve));
    }
  }
  return chart;
}

PageChart albedo_chart(const FitReport& report) {
  PageChart chart{.title = "What each form errs by, over albedo",
                  .about = fmt::format("RMSE of E/π over {}; the best at albedo 0.5 are shown at first.",
                                       judged_unit(report)),
                  .x = "albedo",
                  .y = "RMSE",
                  .log_y = true};
  for (const JudgedForm* form : sorted_forms(report, kMiddle)) {
    PageCurve curve{.name = form_name(*form), .shown = chart.curves.size() < kShownForms};
    for (std::size_t k = 0; k < form->errors.size(); ++k)
      curve.points.push_back({judged_albedos()[k], form->errors[k].rms()});
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

PageChart occlusion_chart(const FitReport& report) {
  PageChart chart{.title = "Where each form errs, at albedo 0.5",
                  .about = "RMSE of E/π over places that are so open, by the kind of AO that the form takes.",
                  .x = "α or A",
                  .y = "RMSE",
                  .log_y = true};
  for (const JudgedForm* form : sorted_forms(report, kMiddle)) {
    PageCurve curve{.name = form_name(*form), .shown = chart.curves.size() < kShownForms};
    for (std::size_t bin = 0; bin < kErrorBins; ++bin) {
      const ErrorTally& error = form->errors_by_ao[kMiddle][bin];
      curve.points.push_back({(static_cast<double>(bin) + 0.5) / kErrorBins,
                              error.weight > 0 ? error.rms() : std::numeric_limits<double>::quiet_NaN()});
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

PageTable judged_table(const FitReport& report) {
  PageTable table{
      .title = "What each form errs by",
      .about = fmt::format("RMSE of E/π over {}, by albedo ρ; the best at 0.5 first. Outside: where the "
                           "form says nothing.",
                           judged_unit(report)),
      .columns = {{"form"}, {"formula"}}};
  for (const std::size_t k : kToldAlbedos)
    table.columns.push_back({fmt::format("ρ = {:g}", judged_albedos()[k])});
  table.columns.push_back({"bias, ρ = 0.5"});
  table.columns.push_back({"outside, %"});
  table.columns.push_back({"source"});
  for (const JudgedForm* form : sorted_forms(report, kMiddle)) {
    std::vector<PageCell> row{{form_name(*form)}, {form->formula}};
    for (const std::size_t k : kToldAlbedos) row.push_back(number_cell(form->errors[k].rms(), 3));
    row.push_back(number_cell(form->errors[kMiddle].bias(), 2));
    row.push_back(number_cell(100 * form->outside_share, 3));
    row.push_back({form->source});
    table.rows.push_back(std::move(row));
  }
  return table;
}

PageTable floor_table(const FitReport& report) {
  PageTable table{
      .title = "How good any formula could be",
      .about =
          "The RMSE of E/π below which no function of these inputs can come, by albedo ρ: the spread "
          "of texels that have the same inputs.",
      .columns = {{"inputs"}},
      .rows = {}};
  for (const std::size_t k : kToldAlbedos)
    table.columns.push_back({fmt::format("ρ = {:g}", judged_albedos()[k])});
  for (const Floor& floor : report.floors) {
    std::vector<PageCell> row{{floor.inputs}};
    for (const std::size_t k : kToldAlbedos) row.push_back(number_cell(floor.rms[k], 3));
    table.rows.push_back(std::move(row));
  }
  return table;
}

PageTable parameter_table(const FitReport& report) {
  PageTable table{
      .title = "The parameters",
      .about =
          "As fitted to all maps, with the interval that 95 % of the draws of a bootstrap keep to, "
          "beside what they are published as, or begin from.",
      .columns = {
          {"form"}, {"parameter"}, {"value"}, {"95 % from"}, {"to"}, {"before"}, {"these maps tell it"}}};
  for (const FittedFamily& fitted : report.families) {
    const FormFamily& family = *fitted.family;
    for (std::size_t p = 0; p < family.parameters.size(); ++p) {
      const auto i = static_cast<Eigen::Index>(p);
      const bool told = is_determined(family, fitted.fit.parameters, fitted.intervals, i);
      table.rows.push_back({{family.name},
                            {family.parameters[p]},
                            number_cell(fitted.fit.parameters[i]),
                            number_cell(fitted.intervals.low[i]),
                            number_cell(fitted.intervals.high[i]),
                            number_cell(family.published[p]),
                            {told ? "yes" : "hardly"}});
    }
  }
  return table;
}

PageTable map_table(const FitReport& report) {
  PageTable table{
      .title = "The maps",
      .about =
          "Maps of one material are left out together. Texels: those that forms are judged on, of "
          "maps whose bounces were saved.",
      .columns = {{"map"}, {"material"}, {"file"}, {"bins over A"}, {"texels"}}};
  for (std::size_t i = 0; i < report.maps.size(); ++i) {
    const JudgedMap& map = report.maps[i];
    table.rows.push_back({{map.name},
                          {map.material},
                          {printable(report.inputs[i])},
                          number_cell(static_cast<double>(map.over_sky.filled.size())),
                          map.texels ? number_cell(static_cast<double>(map.texels->size()), 6) : PageCell{}});
  }
  return table;
}

}  // namespace

void write_fit_page(const std::filesystem::path& path, const FitReport& report,
                    const std::vector<std::filesystem::path>& curves, double seconds) {
  Page page{
      .title = fmt::format("Closed forms fitted to {} map{}", report.maps.size(),
                           report.maps.size() == 1 ? "" : "s"),
      .what =
          "Formulas that tell the light after all bounces (E/π, the irradiance over that of an open, level "
          "place) from ambient occlusion and albedo: their constants as fitted here, and what each formula "
          "errs by against light transport.",
      .asked = fit_asked(report),
      .reached = fit_reached(report),
      .cost = cost_facts(seconds, omp_get_max_threads()),
      .command = noted_command(),
      .inputs = fit_inputs(curves),
      .charts = {albedo_chart(report), occlusion_chart(report)},
      .tables = {judged_table(report), parameter_table(report), map_table(report)}};
  if (!report.floors.empty()) page.tables.insert(page.tables.begin() + 1, floor_table(report));
  for (const FittedPanel& panel : fitted_panels(report)) page.charts.push_back(fitted_chart(panel));
  write_bytes(path, page_html(page));
}

}  // namespace heightlight
