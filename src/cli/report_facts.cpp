#include "cli/report_facts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <system_error>

#include "base/byte_size.h"
#include "cli/warnings.h"
#include "files/image_file.h"
#include "files/printable.h"
#include "solve/solver.h"

namespace heightlight {
namespace {

/// An error beside the one wanted; checks themselves are uncertain by some percent.
PageFact error_fact(const std::string& name, double error, const Evidence& evidence,
                    double standard_error = 0) {
  const double wanted = evidence.error_wanted;
  if (wanted <= 0) return {.name = name, .value = fmt::format("{:.2g}", error)};
  const bool missed = is_missed(error, wanted, standard_error);
  return {.name = name,
          .value = fmt::format("{:.2g} ({:g} wanted{})", error, wanted,
                               error > wanted && !missed ? ", which the check cannot tell apart" : ""),
          .tone = missed ? Tone::bad : Tone::good};
}

std::string method_text(const Evidence& evidence) {
  switch (evidence.visibility) {
    case Visibility::rays:
      return fmt::format("{} rays from every texel", evidence.rays);
    case Visibility::exact_slices:
      return fmt::format("exact slices along {} azimuths", evidence.azimuths);
    case Visibility::horizon_walks:
      break;
  }
  return evidence.azimuths > 0 ? fmt::format("horizon walks along {} azimuths", evidence.azimuths)
                               : "horizon walks";
}

void add_sky_check(const SkyCheck& check, const Evidence& evidence, std::vector<PageFact>& facts) {
  facts.push_back(error_fact("RMSE of the sky view factor", check.sky_view_factor, evidence));
  if (check.bent_normal_rad)
    facts.push_back({.name = "RMSE of the bent normal",
                     .value = fmt::format("{:.2g}°", *check.bent_normal_rad * 180 / std::numbers::pi)});
  facts.push_back({.name = "Checked by",
                   .value = fmt::format("exact walks along {} azimuths from {} texels", check.azimuths,
                                        check.receivers)});
}

void add_total_checks(const Evidence& evidence, std::vector<PageFact>& facts) {
  const HorizonCheck& first = evidence.total_checks.front();
  facts.push_back(error_fact("RMSE of the sky view factor", first.sky_rmse, evidence));
  const HorizonCheck& worst = *std::max_element(
      evidence.total_checks.begin(), evidence.total_checks.end(),
      [](const HorizonCheck& a, const HorizonCheck& b) { return a.total_rmse < b.total_rmse; });
  const std::size_t count = evidence.total_checks.size();
  const std::string name =
      count == 1 ? "RMSE of the total" : fmt::format("RMSE of the total, the worst of {} albedos", count);
  facts.push_back(error_fact(name, worst.total_rmse, evidence, worst.total_standard_error));
  facts.push_back({.name = "Checked by",
                   .value = fmt::format("exact walks along {} azimuths from {} texels", first.azimuths,
                                        first.receivers)});
}

}  // namespace

void add_report_option(CLI::App& command, bool& wanted) {
  command.add_flag("--report", wanted,
                   "also write report.html: one file for any browser, with pictures to zoom and to flip "
                   "between, curves, tables and the evidence for the accuracy");
}

std::vector<PageFact> map_facts(const Heightmap& header, double relief, std::uint64_t missing) {
  std::vector<PageFact> facts{
      {.name = "Map", .value = fmt::format("{} × {} texels", header.height.width, header.height.height)},
      {.name = "Texel",
       .value = fmt::format("{:.4g} × {:.4g} world units", header.spacing.x, header.spacing.y)},
      {.name = "Relief",
       .value = fmt::format("{:.4g} world units from the lowest to the highest sample", relief)},
      {.name = "Edges",
       .value =
           header.boundary == Boundary::tile ? "tile: the map repeats" : "open: nothing is beyond them"}};
  if (missing > 0) facts.push_back({.name = "Missing samples", .value = std::to_string(missing)});
  return facts;
}

std::vector<PageFact> method_facts(const Evidence& evidence) {
  std::vector<PageFact> facts{{.name = "Visibility", .value = method_text(evidence)}};
  if (evidence.error_wanted > 0)
    facts.push_back({.name = "Error wanted", .value = fmt::format("{:g} (RMSE)", evidence.error_wanted)});
  return facts;
}

std::vector<PageFact> reached_facts(const Evidence& evidence) {
  std::vector<PageFact> facts;
  if (!evidence.total_checks.empty()) {
    add_total_checks(evidence, facts);
  } else if (evidence.sky_check) {
    add_sky_check(*evidence.sky_check, evidence, facts);
  } else if (evidence.sky_rmse) {
    facts.push_back(error_fact("RMSE of the sky view factor, about", *evidence.sky_rmse, evidence));
  }
  if (evidence.energy) {
    facts.push_back({.name = "The sum of all bounces at albedo 1, which is 1, is off by",
                     .value = fmt::format("{:.1g}", evidence.energy->sum_max_error)});
    facts.push_back({.name = "Left after the last bounce that is kept apart",
                     .value = fmt::format("{:.2g} on average, albedo 1", evidence.energy->tail_mean)});
  }
  double imbalance = 0;
  for (const EnergyAudit& audit : evidence.audits)
    imbalance = std::max(imbalance, std::abs(audit.found_imbalance));
  if (!evidence.audits.empty())
    facts.push_back({.name = "Energy unaccounted for (neither absorbed nor back in the sky)",
                     .value = fmt::format("{:.2g} %", 100 * imbalance)});
  return facts;
}

std::vector<PageFact> cost_facts(double seconds, int threads) {
  return {{.name = "Time", .value = fmt::format("{:.3g} s", seconds)},
          {.name = "Memory at the peak", .value = format_byte_size(peak_memory())},
          {.name = "Threads", .value = std::to_string(threads)}};
}

PageFact input_fact(const std::filesystem::path& path, const std::string& sha256) {
  return {.name = printable(path), .value = "SHA-256 " + sha256};
}

std::vector<PageFact> input_facts(const std::vector<std::filesystem::path>& paths) {
  std::vector<PageFact> facts;
  std::error_code ignored;
  for (const std::filesystem::path& path : paths) {
    if (std::filesystem::is_regular_file(path, ignored))
      facts.push_back(input_fact(path, sha256_of_file(path)));
  }
  return facts;
}

std::vector<std::string> warning_lines(const std::vector<Warning>& warnings) {
  std::vector<std::string> lines;
  for (const Warning& warning : warnings) lines.push_back(user_message(warning));
  return lines;
}

void append(std::vector<PageFact>& facts, const std::vector<PageFact>& more) {
  facts.insert(facts.end(), more.begin(), more.end());
}

}  // namespace heightlight
