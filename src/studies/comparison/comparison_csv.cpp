#include "comparison/comparison_csv.h"

#include <fmt/core.h>

#include <string>

#include "files/output_file.h"

namespace heightlight {

std::string parameters_and_variant(const ComparisonRow& row) {
  return row.variant.empty() ? row.parameters : row.parameters + "; " + row.variant;
}

void write_comparison_csv(const std::filesystem::path& path, const std::vector<ComparisonRow>& rows) {
  write_file(path, [&](std::FILE* file) {
    fmt::print(file,
               "method,parameters,quantity,seconds,core_seconds,samples_per_texel,rmse,bias,p99,max,psnr\n");
    for (const ComparisonRow& row : rows) {
      fmt::print(file, "{},{},{},{:.6g},{:.6g},", row.method, parameters_and_variant(row), row.quantity,
                 row.cost.wall, row.cost.core);
      if (row.samples_per_texel > 0) fmt::print(file, "{:g}", row.samples_per_texel);
      fmt::print(file, ",{:.6g},{:.6g},{:.6g},{:.6g},", row.error.rmse, row.error.bias, row.error.p99,
                 row.error.largest);
      if (row.quantity != kBentQuantity && row.error.rmse > 0) {
        fmt::print(file, "{:.4g}", peak_signal_to_noise(row.error));
      }
      std::fputc('\n', file);
    }
  });
}

}  // namespace heightlight
