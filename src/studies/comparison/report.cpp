#include "comparison/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "comparison/comparison_csv.h"
#include "comparison/pareto_front.h"
#include "comparison/report_answer.h"
#include "files/output_file.h"

namespace heightlight {
namespace {

constexpr double kErrors[] = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

void write_map(std::FILE* file, const ReportInput& input) {
  const Surface& surface = input.scene.surface;
  fmt::print(file, "# {}: what closed forms make of ambient occlusion\n\n", as_markdown(input.map_name));
  fmt::print(file, "{} × {} texels of {:g} × {:g}, relief {:g}, boundary {}.\n\n", surface.width(),
             surface.height(), surface.map.spacing.x, surface.map.spacing.y, relief(surface.map),
             to_string(surface.map.boundary));
  for (const Warning& warning : input.warnings)
    fmt::print(file, "* Warning: {}\n", as_markdown(warning.message));
  if (!input.warnings.empty()) std::fputc('\n', file);
}

void write_reference(std::FILE* file, const ReportInput& input) {
  const ComparisonReference& reference = input.reference;
  fmt::print(file, "## The reference\n\n");
  fmt::print(
      file,
      "A and bent normals: exact walks along {} azimuths from every texel ({:.3g} core-seconds). On {} "
      "texels, RMSE against {} azimuths: A {:.2g}, bent normal {:.2g}°; against {} rays, whose own noise is "
      "in it: A {:.2g}.\n\n",
      reference.azimuths, reference.cost.core, reference.checked, kCheckAzimuths, reference.sky_rmse,
      reference.bent_rmse_deg, kCheckRays, reference.ray_rmse);
  fmt::print(file, "Total irradiance: horizon walks planned for an error ({:.3g} core-seconds).",
             reference.total_cost.core);
  const std::vector<HorizonCheck>& checks = reference.total_evidence.total_checks;
  for (std::size_t a = 0; a < checks.size(); ++a) {
    fmt::print(file, " Albedo {}: RMSE {:.2g} against exact gathers.", input.scene.albedos[a].label,
               checks[a].total_rmse);
  }
  fmt::print(file,
             "\n\nNo error below the reference's own means anything. Core-seconds are processor time in this "
             "process, the least of up to three runs. Screen-space methods are given their depth buffer "
             "({:.2g} core-seconds); rays and walks set up everything.\n\n",
             input.depth_cost.core);
}

void write_row(std::FILE* file, const ComparisonRow& row) {
  fmt::print(file, "{} ({}) | {:.3g} | {:.2g} | {:+.2g} | {:.2g} |\n", row.method,
             as_markdown(parameters_and_variant(row)), row.cost.core, row.error.rmse, row.error.bias,
             row.error.p99);
}

void write_cheapest(std::FILE* file, const ReportInput& input, const std::string& quantity) {
  fmt::print(file,
             "## The cheapest method for each error: {}\n\n| RMSE wanted | method | core-seconds | RMSE | "
             "bias | p99 |\n|---|---|---|---|---|---|\n",
             quantity);
  for (const double error : kErrors) {
    const ComparisonRow* row = cheapest(input.comparison.rows, quantity, error);
    fmt::print(file, "| {:g} | ", error);
    if (row) {
      write_row(file, *row);
    } else {
      fmt::print(file, "none | | | | |\n");
    }
  }
  std::fputc('\n', file);
}

const ComparisonRow* find_row(const ReportInput& input, const ErrorMap& method, const std::string& variant,
                              const std::string& quantity) {
  for (const ComparisonRow& row : input.comparison.rows) {
    if (row.method == method.title && row.parameters == method.subtitle && row.variant == variant &&
        row.quantity == quantity)
      return &row;
  }
  return nullptr;
}

void write_shown(std::FILE* file, const ReportInput& input) {
  fmt::print(
      file,
      "## The methods drawn: {}\n\n| method | core-seconds | RMSE | bias | p99 |\n|---|---|---|---|---|\n",
      kSkyQuantity);
  for (const ErrorMap& shown : input.comparison.shown) {
    if (const ComparisonRow* row = find_row(input, shown, "", kSkyQuantity)) {
      fmt::print(file, "| ");
      write_row(file, *row);
    }
  }
  std::fputc('\n', file);
}

/// What was made of the methods' AO, in the order of the list of forms; first of all what they make
/// themselves.
std::vector<std::string> tried_variants(const ReportInput& input, const std::string& quantity) {
  std::vector<std::string> variants{""};
  for (const ClosedForm& form : input.scene.forms) {
    const auto& rows = input.comparison.rows;
    if (std::any_of(rows.begin(), rows.end(), [&](const ComparisonRow& row) {
          return row.variant == form.name && row.quantity == quantity;
        }))
      variants.push_back(form.name);
  }
  return variants;
}

/// How much of a total's error is the closed form's: that on the exact AO beside that on each method's.
void write_forms(std::FILE* file, const ReportInput& input, const ComparedAlbedo& albedo) {
  const std::string quantity = total_quantity(albedo);
  const std::vector<std::string> variants = tried_variants(input, quantity);
  fmt::print(file, "## All forms on each method's AO, RMSE: {}\n\n| AO |", quantity);
  for (const std::string& variant : variants)
    fmt::print(file, " {} |", variant.empty() ? "its own" : variant);
  fmt::print(file, "\n|---|");
  for (std::size_t i = 0; i < variants.size(); ++i) fmt::print(file, "---|");
  std::fputc('\n', file);
  const auto write_line = [&](const ErrorMap& method) {
    fmt::print(file, "| {} ({}) |", method.title, method.subtitle);
    for (const std::string& variant : variants) {
      const ComparisonRow* row = find_row(input, method, variant, quantity);
      fmt::print(file, "{} |", row ? fmt::format(" {:.4f}", row->error.rmse) : "");
    }
    std::fputc('\n', file);
  };
  write_line({.title = kExactMethod,
              .subtitle = std::to_string(input.reference.azimuths) + " azimuths",
              .error = {},
              .differences = {}});
  for (const ErrorMap& shown : input.comparison.shown) write_line(shown);
  std::fputc('\n', file);
}

/// Where a sky is not the same all over, AO alone does not tell what comes from it.
void write_sky_light(std::FILE* file, const ReportInput& input) {
  fmt::print(
      file,
      "## Direct light of {}\n\nE/π, in units of what a level open plane receives; sky_light.png shows "
      "it. By normal and by bent normal: AO times a prefiltered sky.\n\n"
      "| method | core-seconds | RMSE | bias | p99 |\n|---|---|---|---|---|\n",
      as_markdown(input.reference.sky.label));
  for (const ComparisonRow& row : input.comparison.rows) {
    if (row.quantity != input.reference.sky.quantity) continue;
    fmt::print(file, "| ");
    write_row(file, row);
  }
  std::fputc('\n', file);
}

/// Ritschel et al. 2009, table 1: what the stages take apart.
void write_stages(std::FILE* file, const ReportInput& input) {
  if (input.comparison.stages.empty()) return;
  fmt::print(file, "## Stages, core-seconds\n\n| method | AO and direct irradiance |");
  for (const ComparedAlbedo& albedo : input.scene.albedos)
    fmt::print(file, " bounce, albedo {} |", albedo.label);
  fmt::print(file, "\n|---|---|");
  for (std::size_t a = 0; a < input.scene.albedos.size(); ++a) fmt::print(file, "---|");
  std::fputc('\n', file);
  for (const StageCost& stage : input.comparison.stages) {
    fmt::print(file, "| {} ({}) | {:.2g} |", stage.method, stage.parameters, stage.occlusion_core_seconds);
    for (const double seconds : stage.bounce_core_seconds) fmt::print(file, " {:.2g} |", seconds);
    std::fputc('\n', file);
  }
  std::fputc('\n', file);
}

}  // namespace

void write_report(const std::filesystem::path& path, const ReportInput& input) {
  write_file(path, [&](std::FILE* file) {
    write_map(file, input);
    write_answer(file, input);
    write_reference(file, input);
    write_cheapest(file, input, kSkyQuantity);
    for (const ComparedAlbedo& albedo : input.scene.albedos) {
      write_cheapest(file, input, total_quantity(albedo));
    }
    write_shown(file, input);
    for (const ComparedAlbedo& albedo : input.scene.albedos) write_forms(file, input, albedo);
    write_sky_light(file, input);
    write_stages(file, input);
  });
}

}  // namespace heightlight
