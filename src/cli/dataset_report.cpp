#include "cli/dataset_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/noted_command.h"
#include "cli/report_facts.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "heightlight/curves.h"
#include "heightlight/files.h"
#include "report/page.h"

namespace heightlight {
namespace {

constexpr std::size_t kDrawnRuns = 60;
constexpr std::size_t kShownRuns = 8;

using Summary = nlohmann::ordered_json;

double number_at(const Summary& summary, const char* pointer) {
  const Summary::json_pointer place(pointer);
  if (!summary.contains(place) || !summary.at(place).is_number()) return std::nan("");
  return summary.at(place).get<double>();
}

PageTable run_table(const std::vector<ReportedRun>& done) {
  PageTable table{
      .title = "The runs",
      .about = "A folder each in runs/, with what simulate writes. RMSE: as checked against exact walks.",
      .columns = {{"run"},
                  {"map"},
                  {"relief, share of the width"},
                  {"edges"},
                  {"options"},
                  {"RMSE of A"},
                  {"RMSE of the total"},
                  {"RMSE wanted"},
                  {"mean A of what is seen"},
                  {.name = "seconds", .of_cost = true}},
      .rows = {}};
  for (const ReportedRun& run : done) {
    const Summary& summary = run.summary;
    const double width = number_at(summary, "/map/width") * number_at(summary, "/map/texel/0");
    table.rows.push_back({{run.run.name},
                          {run.run.map->name},
                          number_cell(number_at(summary, "/map/relief") / width),
                          {summary.at("map").at("boundary").get<std::string>()},
                          {run.run.options->name},
                          number_cell(number_at(summary, "/visibility/rmse_estimate"), 2),
                          number_cell(number_at(summary, "/visibility/checked/total_rmse"), 2),
                          number_cell(number_at(summary, "/visibility/error_wanted"), 3),
                          number_cell(number_at(summary, "/seen/mean_sky_view_factor"), 4),
                          number_cell(number_at(summary, "/time_s/total"), 3)});
  }
  return table;
}

PageTable failure_table(const std::vector<DatasetRun>& runs) {
  PageTable table{.title = "The runs that failed",
                  .about = "They are in no table and no curve.",
                  .columns = {{"run"}, {"map"}, {"why"}},
                  .rows = {}};
  for (const DatasetRun& run : runs) {
    if (!run.fault.empty()) table.rows.push_back({{run.name}, {run.map->name}, {run.fault}});
  }
  return table;
}

/// Two charts of the same bounces of each run: what the sky sends and what the first bounce brings.
std::vector<PageChart> bounce_charts(const std::vector<ReportedRun>& done) {
  std::vector<PageChart> charts;
  for (const std::size_t bounce : {std::size_t{1}, std::size_t{2}}) {
    charts.push_back({.title = fmt::format("Bounce {} over ambient occlusion α, run by run", bounce),
                      .about = fmt::format(
                          "Mean E/π of bounce {} at albedo 1.{}", bounce,
                          done.size() > kDrawnRuns
                              ? fmt::format(" Of {} runs, the first {} are drawn.", done.size(), kDrawnRuns)
                              : ""),
                      .x = "ambient occlusion α",
                      .y = "E/π",
                      .curves = {}});
  }
  for (std::size_t i = 0; i < std::min(done.size(), kDrawnRuns); ++i) {
    const std::vector<BounceCurves> kinds = read_curves_csv(done[i].run.simulate.folder / "curves.csv");
    for (std::size_t c = 0; c < charts.size(); ++c) {
      PageCurve curve{.name = done[i].run.name, .points = {}, .shown = i < kShownRuns};
      for (const CurveBin& bin : kinds.front().filled) {
        if (c + 1 < bin.bounces.size()) curve.points.push_back({bin.ao_mean, bin.bounces[c + 1].mean});
      }
      charts[c].curves.push_back(std::move(curve));
    }
  }
  return charts;
}

std::vector<PageFact> dataset_asked(const std::vector<DatasetRun>& runs) {
  std::map<std::string, int> maps;
  std::map<std::string, int> options;
  for (const DatasetRun& run : runs) {
    ++maps[run.map->name];
    ++options[run.options->name];
  }
  return {{.name = "Runs", .value = std::to_string(runs.size())},
          {.name = "Maps", .value = std::to_string(maps.size())},
          {.name = "Sets of options", .value = std::to_string(options.size())}};
}

std::vector<PageFact> dataset_reached(const std::vector<ReportedRun>& done, std::size_t failed) {
  std::size_t missed = 0;
  double worst = 0;
  for (const ReportedRun& run : done) {
    const double wanted = number_at(run.summary, "/visibility/error_wanted");
    const double found = number_at(run.summary, "/visibility/checked/total_rmse");
    if (!(wanted > 0) || std::isnan(found)) continue;
    worst = std::max(worst, found / wanted);
    missed += run.summary.at("visibility").value("missed", false) ? 1 : 0;
  }
  std::vector<PageFact> facts{
      {.name = "Runs done", .value = std::to_string(done.size()), .tone = Tone::good}};
  if (failed > 0)
    facts.push_back({.name = "Runs that failed", .value = std::to_string(failed), .tone = Tone::bad});
  if (worst > 0) {
    facts.push_back({.name = "Largest RMSE of a total, of what was wanted",
                     .value = fmt::format("{:.0f} %", 100 * worst),
                     .tone = missed > 0 ? Tone::bad : Tone::good});
  }
  if (missed > 0)
    facts.push_back(
        {.name = "Runs that missed the error wanted", .value = std::to_string(missed), .tone = Tone::bad});
  return facts;
}

/// Of all runs together; what each took may be of different machines.
std::vector<PageFact> dataset_cost(const std::vector<ReportedRun>& done) {
  double seconds = 0;
  for (const ReportedRun& run : done) seconds += number_at(run.summary, "/time_s/total");
  return {{.name = "Time of all runs together", .value = fmt::format("{:.3g} s", seconds)}};
}

std::vector<PageFact> dataset_inputs(const std::vector<ReportedRun>& done) {
  constexpr std::size_t kMost = 40;
  std::map<std::string, std::string> files;
  for (const ReportedRun& run : done) {
    if (!run.run.map->is_shape())
      files[printable(run.run.map->source)] = run.summary.at("map").at("sha256").get<std::string>();
  }
  std::vector<PageFact> facts;
  for (const auto& [file, sha256] : files) {
    if (facts.size() == kMost) {
      facts.push_back(
          {.name = fmt::format("and {} more", files.size() - kMost), .value = "dataset.json has all"});
      break;
    }
    facts.push_back({.name = file, .value = "SHA-256 " + sha256});
  }
  return facts;
}

}  // namespace

void write_dataset_report(const std::filesystem::path& path, const std::vector<ReportedRun>& done,
                          const std::vector<DatasetRun>& runs, const std::filesystem::path& manifest) {
  Page page{
      .title = fmt::format("A dataset of {} run{}", done.size(), done.size() == 1 ? "" : "s"),
      .what =
          "Bounce curves of many maps, reliefs and options: how light after each bounce depends on ambient "
          "occlusion. dataset.csv has all curves, dataset.json where each comes from.",
      .asked = dataset_asked(runs),
      .reached = dataset_reached(done, runs.size() - done.size()),
      .cost = dataset_cost(done),
      .command = noted_command(),
      .inputs = input_facts({manifest}),
      .charts = bounce_charts(done),
      .tables = {run_table(done)}};
  append(page.inputs, dataset_inputs(done));
  if (done.size() < runs.size()) page.tables.push_back(failure_table(runs));
  write_bytes(path, page_html(page));
}

}  // namespace heightlight
