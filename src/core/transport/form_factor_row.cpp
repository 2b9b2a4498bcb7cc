#include <algorithm>
#include <cassert>
#include <cmath>

#include "transport/link_corners.h"

namespace heightlight {
namespace {

struct Entry {
  std::uint64_t texel;
  double value;
};

/// Distributes a link's weight to the corners of its facet, as a linear function on the facet is
/// interpolated.
void add_link(const FormFactors& form_factors, const Link& link, double weight, std::vector<Entry>& entries) {
  const auto width = static_cast<std::uint64_t>(form_factors.width);
  const auto height = static_cast<std::uint64_t>(form_factors.height);
  for (const LinkCorner& corner : corners_of(link, form_factors.width)) {
    if (corner.share <= 0) continue;
    entries.push_back({corner.row % height * width + corner.column % width, weight * corner.share});
  }
}

}  // namespace

FormFactorRow form_factor_row(const FormFactors& form_factors, int row, int column) {
  assert(row >= 0 && row < form_factors.height && column >= 0 && column < form_factors.width);
  const LinkRow& line = form_factors.rows[static_cast<std::size_t>(row)];
  const auto j = static_cast<std::size_t>(column);
  std::vector<Entry> entries;
  for (std::uint64_t k = line.begin[j]; k < line.begin[j + 1]; ++k) {
    const Link& link = line.links[k];
    const double weight = form_factors.ray_weights.empty()
                              ? line.weights[k]
                              : form_factors.ray_weights[line.weight_table[j]][link.weight];
    add_link(form_factors, link, weight, entries);
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.texel < b.texel; });
  FormFactorRow result;
  for (const Entry& entry : entries) {
    if (result.texel.empty() || result.texel.back() != entry.texel) {
      result.texel.push_back(entry.texel);
      result.value.push_back(0);
    }
    result.value.back() += entry.value;
  }
  return result;
}

}  // namespace heightlight
