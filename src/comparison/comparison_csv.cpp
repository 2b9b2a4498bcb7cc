#include "comparison/comparison_csv.h"

#include "io/output_file.h"

namespace heightlight {

void write_comparison_csv(const std::filesystem::path& path, const std::vector<ComparisonRow>& rows) {
  write_file(path, [&](std::FILE* file) {
    std::fputs("method,parameters,quantity,seconds,core_seconds,samples_per_texel,rmse,bias,p99,max,psnr\n",
               file);
    for (const ComparisonRow& row : rows) {
      std::fprintf(file, "%s,%s,%s,%.6g,%.6g,", row.method.c_str(), row.parameters.c_str(),
                   row.quantity.c_str(), row.cost.wall, row.cost.core);
      if (row.samples_per_texel > 0) std::fprintf(file, "%g", row.samples_per_texel);
      std::fprintf(file, ",%.6g,%.6g,%.6g,%.6g,", row.error.rmse, row.error.bias, row.error.p99,
                   row.error.largest);
      if (row.quantity != kBentQuantity && row.error.rmse > 0) {
        std::fprintf(file, "%.4g", peak_signal_to_noise(row.error));
      }
      std::fputc('\n', file);
    }
  });
}

}  // namespace heightlight
