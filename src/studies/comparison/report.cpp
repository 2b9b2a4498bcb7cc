#include "comparison/report.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "comparison/pareto_front.h"
#include "files/output_file.h"

namespace heightlight {
namespace {

constexpr double kErrors[] = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

/// A name as it is, whatever marks it has.
std::string as_markdown(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::string_view("\\`*_{}[]<>()#+-!|&~").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

void write_reference(std::FILE* file, const ReportInput& input) {
  const ComparisonReference& reference = input.reference;
  const Surface& surface = input.scene.surface;
  fmt::print(file, "# Methods compared on {}\n\n", as_markdown(input.map_name));
  fmt::print(file, "{} × {} texels of {:g} × {:g}, relief {:g}, boundary {}.\n\n", surface.width(),
             surface.height(), surface.map.spacing.x, surface.map.spacing.y, relief(surface.map),
             to_string(surface.map.boundary));
  for (const Warning& warning : input.warnings)
    fmt::print(file, "* Warning: {}\n", as_markdown(warning.message));
  fmt::print(file, "{}## The reference\n\n", input.warnings.empty() ? "" : "\n");
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
  fmt::print(file, "{} ({}) | {:.3g} | {:.2g} | {:+.2g} | {:.2g} |\n", row.method, row.parameters,
             row.cost.core, row.error.rmse, row.error.bias, row.error.p99);
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

void write_shown(std::FILE* file, const ReportInput& input) {
  fmt::print(
      file,
      "## The methods drawn: {}\n\n| method | core-seconds | RMSE | bias | p99 |\n|---|---|---|---|---|\n",
      kSkyQuantity);
  for (const ErrorMap& shown : input.comparison.shown) {
    for (const ComparisonRow& row : input.comparison.rows) {
      if (row.method != shown.method || row.parameters != shown.parameters || row.quantity != kSkyQuantity)
        continue;
      fmt::print(file, "| ");
      write_row(file, row);
    }
  }
  std::fputc('\n', file);
}

/// RMSE of a closed form on some AO; NaN where it was not tried.
double form_error(const ReportInput& input, const std::string& method, const std::string& parameters,
                  const std::string& quantity) {
  for (const ComparisonRow& row : input.comparison.rows) {
    if (row.method == method && row.parameters == parameters && row.quantity == quantity)
      return row.error.rmse;
  }
  return std::nan("");
}

/// Names of the closed forms that were tried on the exact AO, as they follow its parameters: "; direct".
std::vector<std::string> tried_forms(const ReportInput& input, const std::string& quantity) {
  std::vector<std::string> forms;
  for (const ComparisonRow& row : input.comparison.rows) {
    if (row.method != kExactMethod || row.quantity != quantity) continue;
    forms.push_back(row.parameters.substr(row.parameters.find(';')));
  }
  return forms;
}

/// How much of a total's error is the closed form's: that on the exact AO beside that on each method's.
void write_forms(std::FILE* file, const ReportInput& input, const ComparedAlbedo& albedo) {
  const std::string quantity = total_quantity(albedo);
  const std::vector<std::string> forms = tried_forms(input, quantity);
  fmt::print(file, "## Closed forms, RMSE: {}\n\n| AO |", quantity);
  for (const std::string& form : forms) fmt::print(file, " {} |", form.substr(2));
  fmt::print(file, "\n|---|");
  for (std::size_t i = 0; i < forms.size(); ++i) fmt::print(file, "---|");
  std::fputc('\n', file);
  const auto write_line = [&](const std::string& method, const std::string& parameters) {
    fmt::print(file, "| {} ({}) |", method, parameters);
    for (const std::string& form : forms) {
      const double error = form_error(input, method, parameters + form, quantity);
      fmt::print(file, "{} |", std::isnan(error) ? "" : fmt::format(" {:.4f}", error));
    }
    std::fputc('\n', file);
  };
  write_line(kExactMethod, std::to_string(input.reference.azimuths) + " azimuths");
  for (const ErrorMap& shown : input.comparison.shown) write_line(shown.method, shown.parameters);
  std::fputc('\n', file);
}

}  // namespace

void write_report(const std::filesystem::path& path, const ReportInput& input) {
  write_file(path, [&](std::FILE* file) {
    write_reference(file, input);
    write_cheapest(file, input, kSkyQuantity);
    for (const ComparedAlbedo& albedo : input.scene.albedos) {
      write_cheapest(file, input, total_quantity(albedo));
    }
    write_shown(file, input);
    for (const ComparedAlbedo& albedo : input.scene.albedos) write_forms(file, input, albedo);
  });
}

}  // namespace heightlight
