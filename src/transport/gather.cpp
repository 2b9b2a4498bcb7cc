#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

/// Linear interpolation of x at the place that a link names, over the triangle it lies in.
double value_at(const Link& link, const TexelVector& x, int width, int height) {
  const std::uint32_t row = link.cell / static_cast<std::uint32_t>(width);
  const std::uint32_t column = link.cell - row * static_cast<std::uint32_t>(width);
  // The last row and column have cells only where the map tiles.
  const std::int64_t right = column + 1 == static_cast<std::uint32_t>(width) ? 1 - std::int64_t{width} : 1;
  const std::int64_t below =
      row + 1 == static_cast<std::uint32_t>(height) ? -std::int64_t{width} * (height - 1) : std::int64_t{width};
  const double* upper_left = x.data() + link.cell;
  const double across = link.across * (1.0 / 255);
  const double down = link.down * (1.0 / 255);
  const double lower_right = upper_left[right + below];
  if (link.across >= link.down) {
    return *upper_left * (1 - across) + upper_left[right] * (across - down) + lower_right * down;
  }
  return *upper_left * (1 - down) + upper_left[below] * (down - across) + lower_right * across;
}

}  // namespace

TexelVector gather(const FormFactors& form_factors, const TexelVector& x) {
  TexelVector result(x.size());
  parallel_for(form_factors.height, [&](std::int64_t row) {
    const LinkRow& line = form_factors.rows[static_cast<std::size_t>(row)];
    for (int column = 0; column < form_factors.width; ++column) {
      const auto j = static_cast<std::size_t>(column);
      const float* weight = form_factors.ray_weights[line.weight_table[j]].data();
      double sum = 0;
      for (std::uint64_t k = line.begin[j]; k < line.begin[j + 1]; ++k) {
        const Link& link = line.links[k];
        sum += static_cast<double>(weight[link.ray]) * value_at(link, x, form_factors.width, form_factors.height);
      }
      result[row * form_factors.width + column] = sum;
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
      const float sky = form_factors.sky_view_factor(row, column);
      if (std::isnan(sky)) continue;
      const float* weight = form_factors.ray_weights[line.weight_table[j]].data();
      double sum = sky;
      for (std::uint64_t k = line.begin[j]; k < line.begin[j + 1]; ++k) {
        sum += static_cast<double>(weight[line.links[k].ray]);
      }
      worst = std::max(worst, std::fabs(sum - 1));
    }
  }
  return worst;
}

TexelVector direct_irradiance(const FormFactors& form_factors) {
  TexelVector direct(static_cast<Eigen::Index>(form_factors.sky_view_factor.size()));
  for (std::size_t i = 0; i < form_factors.sky_view_factor.size(); ++i) {
    const float sky = form_factors.sky_view_factor.values[i];
    direct[static_cast<Eigen::Index>(i)] = std::isnan(sky) ? 0.0 : static_cast<double>(sky);
  }
  return direct;
}

}  // namespace heightlight
