#include "cli/compare_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <istream>
#include <map>
#include <sstream>

#include "cli/noted_command.h"
#include "cli/report_facts.h"
#include "comparison/comparison_csv.h"
#include "comparison/error_statistics.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "report/page.h"

namespace heightlight {
namespace {

std::vector<std::string> split_parameters(const std::string& parameters) {
  std::vector<std::string> parts;
  std::istringstream stream(parameters);
  for (std::string part; std::getline(stream >> std::ws, part, ';');) parts.push_back(part);
  return parts;
}

/// The method, with as many of its parameters as tell it from the others that are shown.
std::string short_name(const std::vector<ErrorMap>& shown, const ErrorMap& method) {
  const auto name_of = [](const ErrorMap& map, std::size_t count) {
    const std::vector<std::string> parts = split_parameters(map.subtitle);
    std::string name = map.title;
    for (std::size_t i = 0; i < std::min(count, parts.size()); ++i) name += (i == 0 ? " " : ", ") + parts[i];
    return name;
  };
  const std::size_t most = split_parameters(method.subtitle).size();
  for (std::size_t count = 0; count < most; ++count) {
    const std::string name = name_of(method, count);
    const auto same = [&](const ErrorMap& other) { return name_of(other, count) == name; };
    if (std::count_if(shown.begin(), shown.end(), same) == 1) return name;
  }
  return name_of(method, most);
}

/// A of the reference, and of each method that is shown.
PictureGroup method_group(const ReportInput& input) {
  const Map& truth = input.reference.sky_view_factor;
  PictureGroup group{
      .title = "The methods: sky view factor",
      .about =
          "What each method takes for the share of the sky that is seen (1 = open), beside the "
          "reference. Switch to the error to see where it goes wrong: blue is too dark, red too "
          "bright.",
      .reference = 0};
  group.pictures.push_back({.name = "reference",
                            .about = fmt::format("Exact walks along {} azimuths.", input.reference.azimuths),
                            .preview = make_preview({&truth})});
  for (const ErrorMap& method : input.comparison.shown) {
    Map values = method.differences;
    for (std::size_t i = 0; i < values.size(); ++i) values.values[i] += truth.values[i];
    group.pictures.push_back({.name = short_name(input.comparison.shown, method),
                              .about = fmt::format("{} ({}); RMSE {:.4f}, bias {:+.4f}.", method.title,
                                                   method.subtitle, method.error.rmse, method.error.bias),
                              .preview = make_preview({&values})});
  }
  return group;
}

PictureGroup truth_group(const ReportInput& input) {
  PictureGroup group{
      .title = "The reference: light after all bounces",
      .about =
          "E/π under an even sky of radiance 1, by light transport, at each albedo; in an open, "
          "level place it is 1."};
  for (std::size_t a = 0; a < input.reference.totals.size(); ++a) {
    const ComparedAlbedo& albedo = input.scene.albedos[a];
    group.pictures.push_back({.name = "albedo " + albedo.label,
                              .about = "E/π of all bounces.",
                              .preview = make_preview({&input.reference.totals[a]})});
  }
  return group;
}

/// What closed forms err by, texel by texel.
PictureGroup form_group(const ReportInput& input) {
  const Surface& surface = input.scene.surface;
  const int side = thinning_step(surface.width(), surface.height());
  PictureGroup group{
      .title = "The closed forms: error of the total at albedo " + input.scene.albedos.back().label,
      .about =
          "What each formula makes of ambient occlusion, less light transport: blue is too dark, "
          "red too bright."};
  for (const ErrorMap& form : input.comparison.total_errors) {
    if (form.differences.size() == 0) continue;
    group.pictures.push_back(
        {.name = form.title + ", " + form.subtitle,
         .about = fmt::format("RMSE {:.4f}, bias {:+.4f}.", form.error.rmse, form.error.bias),
         .kind = PictureKind::error,
         .preview = picked_preview(form.differences, surface.width(), surface.height(), side)});
  }
  return group;
}

PageChart pareto_chart(const ReportInput& input, const std::string& quantity) {
  std::map<std::string, PageCurve> by_method;
  for (const ComparisonRow& row : input.comparison.rows) {
    if (row.quantity != quantity || row.method == kExactMethod || row.error.rmse <= 0) continue;
    const std::string name = row.variant.empty() ? row.method : "closed forms on " + row.method;
    PageCurve& curve = by_method[name];
    curve.name = name;
    curve.points.push_back({row.cost.core, row.error.rmse});
    curve.labels.push_back(parameters_and_variant(row));
  }
  PageChart chart{.title = "Time against error: " + quantity,
                  .about =
                      "Each dot is a method with its parameters: farther down is more exact, farther left is "
                      "cheaper. Point at a dot to see which it is.",
                  .x = "core-seconds",
                  .y = "RMSE",
                  .log_x = true,
                  .log_y = true,
                  .dots = true,
                  .of_cost = true};
  for (auto& [name, curve] : by_method) chart.curves.push_back(std::move(curve));
  return chart;
}

PageChart form_chart(const FormPanel& panel) {
  const std::string ao = panel.kind == AoKind::sky_view_factor ? "sky view factor A" : "ambient occlusion α";
  PageChart chart{
      .title = fmt::format("Closed forms over {}, albedo {} ({})", ao, panel.albedo, panel.role),
      .about =
          "Measured: the mean of light transport over places that are so open, and the band that 90 "
          "% of them keep to. A form that is near the mean can still be wrong in single places.",
      .x = ao,
      .y = "E/π"};
  PageCurve mean{.name = "measured mean"};
  PageCurve low{.name = "measured, 5 %", .dashed = true};
  PageCurve high{.name = "measured, 95 %", .dashed = true};
  for (const PanelBin& bin : panel.measured) {
    mean.points.push_back({bin.ao, bin.mean});
    low.points.push_back({bin.ao, bin.low});
    high.points.push_back({bin.ao, bin.high});
  }
  chart.curves = {std::move(mean), std::move(low), std::move(high)};
  for (const PanelCurve& curve : panel.curves)
    chart.curves.push_back({.name = curve.label, .points = curve.points});
  return chart;
}

PageTable answer_table(const ReportInput& input) {
  PageTable table{
      .title = "What the closed forms err by",
      .about = "RMSE of E/π against light transport. Outside: texels for which the form says nothing.",
      .columns = {{.name = "ambient occlusion by"}, {.name = "form"}}};
  for (const std::string& albedo : input.answer.albedos)
    table.columns.push_back({.name = "RMSE, albedo " + albedo});
  table.columns.push_back({.name = "outside, %"});
  for (const AnswerGroup& group : input.answer.groups) {
    for (const AnswerLine& line : group.lines) {
      std::vector<PageCell> row{{.text = group.role + " (" + group.parameters + ")"}, {.text = line.label}};
      for (const ErrorStatistics& error : line.errors) row.push_back(number_cell(error.rmse, 3));
      row.push_back(number_cell(100 * line.outside_share, 3));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

PageTable row_table(const ReportInput& input) {
  PageTable table{.title = "All that was measured",
                  .about = "As in compare.csv. Core-seconds are processor time.",
                  .columns = {{.name = "method"},
                              {.name = "parameters"},
                              {.name = "quantity"},
                              {.name = "RMSE"},
                              {.name = "bias"},
                              {.name = "99 % within"},
                              {.name = "core-seconds", .of_cost = true}}};
  for (const ComparisonRow& row : input.comparison.rows) {
    table.rows.push_back({{.text = row.method},
                          {.text = parameters_and_variant(row)},
                          {.text = row.quantity},
                          number_cell(row.error.rmse, 3),
                          number_cell(row.error.bias, 3),
                          number_cell(row.error.p99, 3),
                          number_cell(row.cost.core, 3)});
  }
  return table;
}

std::vector<PageFact> comparison_asked(const ReportInput& input) {
  const Surface& surface = input.scene.surface;
  std::vector<PageFact> facts = map_facts(surface.map, relief(surface.map), count_missing(surface.map));
  std::string albedos;
  for (const ComparedAlbedo& albedo : input.scene.albedos)
    albedos += (albedos.empty() ? "" : ", ") + printable(albedo.label);
  facts.push_back({.name = "Albedos", .value = albedos});
  facts.push_back(
      {.name = "Reference",
       .value = fmt::format("exact walks along {} azimuths from every texel", input.reference.azimuths)});
  return facts;
}

/// The answer in words, then what the reference itself errs by.
std::vector<PageFact> comparison_reached(const ReportInput& input) {
  std::vector<PageFact> facts;
  const std::size_t last = input.answer.albedos.size() - 1;
  for (const AnswerGroup& group : input.answer.groups) {
    if (const AnswerLine* best = best_line(group, last))
      facts.push_back(
          {.name = fmt::format("Best form at albedo {} on {}", input.answer.albedos[last], group.role),
           .value = fmt::format("{}: RMSE {:.3f}", best->label, best->errors[last].rmse)});
  }
  const ComparisonReference& reference = input.reference;
  facts.push_back({.name = "The reference's own error of A",
                   .value = fmt::format("{:.2g} against {} azimuths on {} texels; {:.2g} against {} rays",
                                        reference.sky_rmse, kCheckAzimuths, reference.checked,
                                        reference.ray_rmse, kCheckRays)});
  const std::vector<HorizonCheck>& checks = reference.total_evidence.total_checks;
  for (std::size_t a = 0; a < checks.size(); ++a) {
    facts.push_back({.name = "The reference's own error of the total, albedo " + input.scene.albedos[a].label,
                     .value = fmt::format("{:.2g} against exact gathers", checks[a].total_rmse)});
  }
  return facts;
}

}  // namespace

std::uint64_t comparison_report_bytes(const Surface& surface, std::size_t albedos) {
  const std::size_t methods = shown_methods().size();
  return page_bytes(surface.width(), surface.height(), 1 + methods + albedos);
}

void write_comparison_report(const std::filesystem::path& path, const std::vector<PageFact>& inputs,
                             const ReportInput& input, double seconds) {
  Page page{
      .title = input.map_name + ": methods compared",
      .what = "What games' methods and closed formulas for ambient occlusion and bounces err by on " +
              input.map_name +
              ", beside light transport on the same surface: what errors look like, how large they are, and "
              "what each method costs.",
      .asked = comparison_asked(input),
      .reached = comparison_reached(input),
      .cost = cost_facts(seconds, input.reference.total_evidence.threads),
      .command = noted_command(),
      .inputs = inputs,
      .warnings = warning_lines(input.warnings),
      .groups = {method_group(input), form_group(input), truth_group(input)}};
  page.charts.push_back(pareto_chart(input, kSkyQuantity));
  page.charts.push_back(pareto_chart(input, total_quantity(input.scene.albedos.back())));
  for (const FormPanel& panel : input.comparison.panels) {
    if (panel.albedo == input.scene.albedos.back().label) page.charts.push_back(form_chart(panel));
  }
  page.tables = {answer_table(input), row_table(input)};
  write_bytes(path, page_html(page));
}

}  // namespace heightlight
