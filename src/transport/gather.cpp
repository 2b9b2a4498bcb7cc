#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

/// x with a column on the right and a row below that repeat the first ones, so that a link need not know
/// whether its cell wraps. (Where the map is open, no link lies there.)
TexelVector pad(const FormFactors& form_factors, const TexelVector& x) {
  const Eigen::Index width = form_factors.width;
  const Eigen::Index height = form_factors.height;
  TexelVector padded((width + 1) * (height + 1));
  for (Eigen::Index row = 0; row <= height; ++row) {
    const Eigen::Index from = row % height * width;
    padded.segment(row * (width + 1), width) = x.segment(from, width);
    padded[row * (width + 1) + width] = x[from];
  }
  return padded;
}

/// 255 times the linear interpolation of `padded` at the place that a link names. In the triangle it lies in,
/// the corner on the diagonal's upper end weighs 1 − max(across, down), the one on its lower end min(across,
/// down), and the corner off the diagonal |across − down|.
double value_at(const Link& link, const double* padded, std::uint32_t stride) {
  const double* upper_left = padded + link.cell;
  const bool upper_right = link.across >= link.down;
  const int larger = upper_right ? link.across : link.down;
  const int smaller = upper_right ? link.down : link.across;
  const double* corner = upper_left + (upper_right ? 1 : stride);
  return (255 - larger) * *upper_left + (larger - smaller) * *corner + smaller * upper_left[stride + 1];
}

}  // namespace

TexelVector gather(const FormFactors& form_factors, const TexelVector& x) {
  TexelVector result(x.size());
  const TexelVector padded = pad(form_factors, x);
  const std::uint32_t stride = static_cast<std::uint32_t>(form_factors.width) + 1;
  parallel_for(form_factors.height, [&](std::int64_t row) {
    const LinkRow& line = form_factors.rows[static_cast<std::size_t>(row)];
    for (int column = 0; column < form_factors.width; ++column) {
      const auto j = static_cast<std::size_t>(column);
      const double* weight = form_factors.ray_weights[line.weight_table[j]].data();
      double sum = 0;
      for (std::uint64_t k = line.begin[j]; k < line.begin[j + 1]; ++k) {
        const Link& link = line.links[k];
        sum += weight[link.ray] * value_at(link, padded.data(), stride);
      }
      result[row * form_factors.width + column] = sum / 255;
    }
  });
  return result;
}

double row_sum_error(const FormFactors& form_factors) {
  double worst = 0;
  for (int row = 0; row < form_factors.height; ++row) {
    const LinkRow& line = form_factors.rows[static_cast<std::size_t>(row)];
    for (int column = 0; column < form_factors.width; ++column) {
      const auto j = static_cast<std::size_t>(column);
      if (std::isnan(form_factors.sky_view_factor(row, column))) continue;
      const double* weight = form_factors.ray_weights[line.weight_table[j]].data();
      double sum = form_factors.direct[Eigen::Index{row} * form_factors.width + column];
      for (std::uint64_t k = line.begin[j]; k < line.begin[j + 1]; ++k) {
        sum += weight[line.links[k].ray];
      }
      worst = std::max(worst, std::fabs(sum - 1));
    }
  }
  return worst;
}

}  // namespace heightlight
