#include "cli/dataset_tables.h"

#include <fmt/core.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/digits.h"
#include "cli/dataset_locks.h"
#include "cli/dataset_origin.h"
#include "cli/dataset_report.h"
#include "cli/report_facts.h"
#include "files/evidence_json.h"
#include "files/input_file.h"
#include "files/interrupt.h"
#include "files/json_file.h"
#include "files/lock_file.h"
#include "files/output_file.h"
#include "files/staged_output.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

Json read_summary(const DatasetRun& run) { return Json(read_json(run.simulate.folder / "summary.json")); }

/// As far as single precision, in which heights are kept, tells it.
float actual_relief_share(const Json& map) {
  const double share =
      map.at("relief").get<double>() / (map.at("width").get<double>() * map.at("texel").at(0).get<double>());
  return static_cast<float>(share);
}

/// The cells that every line of a run begins with.
std::string describe_line(const DatasetRun& run, const Json& summary) {
  const Json& map = summary.at("map");
  const std::string share =
      run.relief_share ? in_digits(*run.relief_share) : in_digits(actual_relief_share(map));
  return run.name + ',' + run.map->name + ',' + share + ',' + map.at("boundary").get<std::string>() + ',' +
         run.options->name + ',';
}

/// Copies the curves of a run, each line with its cells before it.
void append_curves(const DatasetRun& run, const std::string& cells, std::FILE* table) {
  throw_if_interrupted();
  const fs::path path = run.simulate.folder / "curves.csv";
  std::ifstream curves(path, std::ios::binary);
  std::string line;
  if (!std::getline(curves, line) || line != kCurvesHeader) throw file_error(path, "holds no curves");
  while (std::getline(curves, line)) {
    line.insert(0, cells).append("\n");
    std::fwrite(line.data(), 1, line.size(), table);
  }
  if (!curves.eof()) throw file_error(path, "cannot be read to its end");
}

Json describe_options(const DatasetRun& run) {
  const SimulateOptions& simulate = run.simulate;
  return {{"name", run.options->name},
          {"bounces", simulate.bounces},
          {"bins", simulate.bins},
          {"albedo", run.options->albedo_file.empty() ? simulate.albedo : run.options->albedo_file},
          {"save_bounces", simulate.save_bounces}};
}

Json describe_source(const ManifestMap& map) {
  if (map.is_shape()) return {{"shape", map.source}, {"size", map.size}, {"seed", map.seed}};
  return {{"file", map.source}};
}

/// What does not depend on this machine's memory, folders and speed.
Json describe_run(const DatasetRun& run, const Json& summary) {
  Json map = summary.at("map");
  map.erase("path");
  return {{"run", run.name},
          {"key", run.key},
          {"map", run.map->name},
          {"source", describe_source(*run.map)},
          {"surface", map},
          {"options", describe_options(run)},
          {"visibility", summary.at("visibility")},
          {"links", summary.at("links")},
          {"energy", summary.at("energy")},
          {"seen", summary.at("seen")}};
}

Json describe_failure(const DatasetRun& run) {
  return {
      {"run", run.name}, {"map", run.map->name}, {"source", describe_source(*run.map)}, {"fault", run.fault}};
}

constexpr std::array kTables{"dataset.csv", "costs.csv", kReportFile, "dataset.json"};

constexpr std::array kSteps{"load",  "visibility", "transport", "bounces",
                            "check", "curves",     "output",    "total"};

std::string cost_header() {
  std::string header = "run";
  for (const char* step : kSteps) header += std::string(",") + step + "_s";
  return header + ",links,link_bytes,threads\n";
}

std::string cost_line(const DatasetRun& run, const Json& summary) {
  std::string line = run.name;
  for (const char* step : kSteps) {
    (line += ',') += in_digits(summary.at("time_s").at(step).get<double>());
  }
  const Json& links = summary.at("links");
  for (const Json& value : {links.at("count"), links.at("bytes"), summary.at("threads")}) {
    (line += ',') += std::to_string(value.get<std::uint64_t>());
  }
  return line + '\n';
}

}  // namespace

void check_summary(const DatasetRun& run, const nlohmann::json& summary) {
  const Json all(summary);
  describe_line(run, all);
  describe_run(run, all);
  cost_line(run, all);
}

void refuse_to_replace(const std::vector<fs::path>& inputs, const fs::path& folder) {
  const InputGuard guard(inputs);
  for (const char* name : kTables) guard.check(folder / name);
  guard.check(folder / kOriginFile);
}

void write_tables(const Json& origin, const std::vector<DatasetRun>& runs, const fs::path& folder,
                  const std::vector<fs::path>& inputs, bool with_report) {
  const auto lock = LockFile::take(tables_lock_path(folder));
  StagedFolder staged(folder, inputs, {kTables.begin(), kTables.end()});
  Json done = Json::array();
  Json failed = Json::array();
  std::string costs = cost_header();
  std::vector<ReportedRun> reported;
  write_file(staged.file("dataset.csv"), [&](std::FILE* table) {
    fmt::print(table, "run,map,relief_share,boundary,options,{}\n", kCurvesHeader);
    for (const DatasetRun& run : runs) {
      if (!run.fault.empty()) {
        failed.push_back(describe_failure(run));
        continue;
      }
      const Json summary = read_summary(run);
      append_curves(run, describe_line(run, summary), table);
      done.push_back(describe_run(run, summary));
      costs += cost_line(run, summary);
      if (with_report) reported.push_back({.run = run, .summary = summary});
    }
  });
  write_bytes(staged.file("costs.csv"), costs);
  if (with_report) write_dataset_report(staged.file(kReportFile), reported, runs, inputs.front());
  Json all = origin;
  all["runs"] = done;
  all["failed"] = failed;
  write_bytes(staged.file("dataset.json"), json_text(all));
  staged.commit();
}

}  // namespace heightlight
