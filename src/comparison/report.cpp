#include "comparison/report.h"

#include <algorithm>
#include <cmath>

#include "comparison/pareto_front.h"
#include "io/output_file.h"

namespace heightlight {
namespace {

constexpr double kErrors[] = {0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};

void write_reference(std::FILE* file, const ReportInput& input) {
  const Reference& reference = input.reference;
  const Surface& surface = input.scene.surface;
  std::fprintf(file, "# Methods compared on %s\n\n", input.map_name.c_str());
  std::fprintf(file, "%d × %d texels of %g × %g, relief %g, boundary %s.\n\n", surface.width(),
               surface.height(), surface.map.spacing.x, surface.map.spacing.y, relief(surface.map),
               to_string(surface.map.boundary));
  std::fprintf(file, "## The reference\n\n");
  std::fprintf(
      file,
      "A and bent normals: exact walks along %d azimuths from every texel (%.3g core-seconds). On %d "
      "texels, RMSE against %d azimuths: A %.2g, bent normal %.2g°; against %d rays, whose own noise is "
      "in it: A %.2g.\n\n",
      reference.azimuths, reference.cost.core, reference.checked, kCheckAzimuths, reference.sky_rmse,
      reference.bent_rmse_deg, kCheckRays, reference.ray_rmse);
  std::fprintf(file, "Total irradiance: horizon walks planned for an error (%.3g core-seconds).",
               reference.total_cost.core);
  for (std::size_t a = 0; a < reference.total_rmse.size(); ++a) {
    std::fprintf(file, " Albedo %s: RMSE %.2g against exact gathers.", input.scene.albedos[a].label.c_str(),
                 reference.total_rmse[a]);
  }
  std::fprintf(
      file,
      "\n\nNo error below the reference's own means anything. Core-seconds are processor time in this "
      "process, the least of up to three runs. Screen-space methods are given their depth buffer "
      "(%.2g core-seconds); rays and walks set up everything.\n\n",
      input.depth_cost.core);
}

void write_row(std::FILE* file, const ComparisonRow& row) {
  std::fprintf(file, "%s (%s) | %.3g | %.2g | %+.2g | %.2g |\n", row.method.c_str(), row.parameters.c_str(),
               row.cost.core, row.error.rmse, row.error.bias, row.error.p99);
}

void write_cheapest(std::FILE* file, const ReportInput& input, const std::string& quantity) {
  std::fprintf(file,
               "## The cheapest method for each error: %s\n\n| RMSE wanted | method | core-seconds | RMSE | "
               "bias | p99 |\n|---|---|---|---|---|---|\n",
               quantity.c_str());
  for (const double error : kErrors) {
    const ComparisonRow* row = cheapest(input.comparison.rows, quantity, error);
    std::fprintf(file, "| %g | ", error);
    if (row) {
      write_row(file, *row);
    } else {
      std::fprintf(file, "none | | | | |\n");
    }
  }
  std::fputc('\n', file);
}

void write_shown(std::FILE* file, const ReportInput& input) {
  std::fprintf(
      file,
      "## The methods drawn: %s\n\n| method | core-seconds | RMSE | bias | p99 |\n|---|---|---|---|---|\n",
      kSkyQuantity);
  for (const ErrorMap& shown : input.comparison.shown) {
    for (const ComparisonRow& row : input.comparison.rows) {
      if (row.method != shown.method || row.parameters != shown.parameters || row.quantity != kSkyQuantity)
        continue;
      std::fprintf(file, "| ");
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
  std::fprintf(file, "## Closed forms, RMSE: %s\n\n| AO |", quantity.c_str());
  for (const std::string& form : forms) std::fprintf(file, " %s |", form.substr(2).c_str());
  std::fprintf(file, "\n|---|");
  for (std::size_t i = 0; i < forms.size(); ++i) std::fprintf(file, "---|");
  std::fputc('\n', file);
  const auto write_line = [&](const std::string& method, const std::string& parameters) {
    std::fprintf(file, "| %s (%s) |", method.c_str(), parameters.c_str());
    for (const std::string& form : forms) {
      const double error = form_error(input, method, parameters + form, quantity);
      std::isnan(error) ? std::fprintf(file, " |") : std::fprintf(file, " %.4f |", error);
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
