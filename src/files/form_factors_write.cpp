#include <string>
#include <vector>

#include "base/parallel.h"
#include "files/npz_file.h"
#include "files/output_file.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

/// Calls visit(row) with the links of every texel, in order; expands one line of the map at a time.
template <class Visit>
void for_rows(const FormFactors& form_factors, Visit&& visit) {
  std::vector<FormFactorRow> line(static_cast<std::size_t>(form_factors.width));
  for (int row = 0; row < form_factors.height; ++row) {
    parallel_for(form_factors.width, [&](std::int64_t column) {
      line[static_cast<std::size_t>(column)] = form_factor_row(form_factors, row, static_cast<int>(column));
    });
    for (const FormFactorRow& texel : line) visit(texel);
  }
}

}  // namespace

void write_form_factors(const std::filesystem::path& path, const FormFactors& form_factors) {
  const std::uint64_t texels = form_factors.direct.size();
  std::vector<std::int64_t> ends{0};
  for_rows(form_factors, [&](const FormFactorRow& row) {
    ends.push_back(ends.back() + static_cast<std::int64_t>(row.texel.size()));
  });
  const auto count = static_cast<std::uint64_t>(ends.back());
  write_file(path, [&](std::FILE* stream) {
    NpzFile file(stream);
    file.begin_array("format", "|S3", {});
    file.append("csr", 3);
    file.begin_array("shape", "<i8", {2});
    file.append(std::vector<std::int64_t>(2, static_cast<std::int64_t>(texels)));
    file.begin_array("indptr", "<i8", {texels + 1});
    file.append(ends);
    file.begin_array("indices", "<i8", {count});
    for_rows(form_factors, [&](const FormFactorRow& row) { file.append(row.texel); });
    file.begin_array("data", "<f8", {count});
    for_rows(form_factors, [&](const FormFactorRow& row) { file.append(row.value); });
    file.begin_array("sky_view_factor", "<f8", {texels});
    file.append(form_factors.direct);
    file.begin_array("map_shape", "<i8", {2});
    file.append(std::vector<std::int64_t>{form_factors.height, form_factors.width});
    file.finish();
  });
}

}  // namespace heightlight
