#include "terrain/terrain_csv.h"

#include <fmt/core.h>

#include "files/output_file.h"

namespace heightlight {
namespace {

/// Nothing for 0.
std::string unless_zero(double value) { return value > 0 ? fmt::format("{:g}", value) : ""; }

}  // namespace

void write_terrain_forms_csv(const std::filesystem::path& path, const std::vector<TerrainFormRow>& rows) {
  write_file(path, [&](std::FILE* file) {
    fmt::print(file, "light,albedo,form,window,rmse,bias,p95,reflected_mean,relative_rmse,relative_bias\n");
    for (const TerrainFormRow& row : rows) {
      fmt::print(file, "{},{:g},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", row.light, row.albedo,
                 row.form, unless_zero(row.window), row.error.rmse, row.error.bias, row.error.p95,
                 row.reflected, row.relative_rmse(), row.relative_bias());
    }
  });
}

void write_terrain_methods_csv(const std::filesystem::path& path, const std::vector<TerrainMethodRow>& rows) {
  write_file(path, [&](std::FILE* file) {
    fmt::print(file,
               "method,azimuths,reach_cells,error_wanted,definition,below_horizontal,seconds,core_seconds,"
               "core_seconds_per_megatexel,rmse,bias,p95\n");
    for (const TerrainMethodRow& row : rows) {
      fmt::print(file, "{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n", row.method,
                 unless_zero(row.azimuths), unless_zero(row.cells), unless_zero(row.error_wanted),
                 facts_of(row.quantity.definition).name,
                 row.quantity.below == BelowHorizontal::ground ? "ground" : "sky", row.cost.wall,
                 row.cost.core, row.per_megatexel, row.error.rmse, row.error.bias, row.error.p95);
    }
  });
}

}  // namespace heightlight
