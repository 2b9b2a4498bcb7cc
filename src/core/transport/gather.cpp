#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

/// Returns x with a column on the right and a row below that repeat the first ones, so that a link need not
/// know whether its cell wraps. (On an open map no link lies there.)
TexelVector pad(const FormFactors& form_factors, const TexelVector& x) {
  const auto width = static_cast<std::size_t>(form_factors.width);
  const auto height = static_cast<std::size_t>(form_factors.height);
  TexelVector padded((width + 1) * (height + 1));
  for (std::size_t row = 0; row <= height; ++row) {
    const double* from = x.data() + row % height * width;
    double* to = padded.data() + row * (width + 1);
    std::copy_n(from, width, to);
    to[width] = *from;
  }
  return padded;
}

/// k/255 for each k: a load costs less than a conversion and a multiplication.
const std::array<double, 256> kUnit = [] {
  std::array<double, 256> unit{};
  for (std::size_t k = 0; k < unit.size(); ++k) unit[k] = static_cast<double>(k) / 255;
  return unit;
}();

/// Linear interpolation of `padded` at the place that a link names. With m = min(across, down), the lower
/// right corner has the weight m, and the corner off the diagonal |across − down|: of across − m and down −
/// m, one is this and the other 0, depending on the triangle. There is no branch, and a constant is
/// interpolated exactly.
double value_at(const Link& link, const double* padded, std::uint32_t stride) {
  const double* corner = padded + link.cell;
  const double across = kUnit[link.across];
  const double down = kUnit[link.down];
  const double both = across < down ? across : down;
  const double upper_left = corner[0];
  return upper_left + (across - both) * (corner[1] - upper_left) +
         (down - both) * (corner[stride] - upper_left) + both * (corner[stride + 1] - upper_left);
}

/// Weighted sum over a receiver's links: `weight_of(k)` is the weight of link k.
template <class WeightOf>
double sum_links(const LinkRow& line, std::size_t column, const double* padded, std::uint32_t stride,
                 WeightOf&& weight_of) {
  double sum = 0;
  for (std::uint64_t k = line.begin[column]; k < line.begin[column + 1]; ++k) {
    sum += weight_of(k) * value_at(line.links[k], padded, stride);
  }
  return sum;
}

}  // namespace

TexelVector FormFactors::gather(const TexelVector& x) const {
  TexelVector result(x.size());
  const TexelVector padded = pad(*this, x);
  const std::uint32_t stride = static_cast<std::uint32_t>(width) + 1;
  parallel_for(height, [&](std::int64_t row) {
    const LinkRow& line = rows[static_cast<std::size_t>(row)];
    for (int column = 0; column < width; ++column) {
      const auto j = static_cast<std::size_t>(column);
      double& sum = result[static_cast<std::size_t>(row * width + column)];
      if (ray_weights.empty()) {
        sum = sum_links(line, j, padded.data(), stride, [&](std::uint64_t k) { return line.weights[k]; });
      } else {
        const double* weight = ray_weights[line.weight_table[j]].data();
        sum = sum_links(line, j, padded.data(), stride,
                        [&](std::uint64_t k) { return weight[line.links[k].weight]; });
      }
    }
  });
  return result;
}

std::unique_ptr<BounceSequence> Transport::start_bounces() const {
  class Gathers : public BounceSequence {
   public:
    explicit Gathers(const Transport& transport) : transport_(transport) {}
    TexelVector next(const TexelVector& last, const TexelVector&) override { return transport_.gather(last); }

   private:
    const Transport& transport_;
  };
  return std::make_unique<Gathers>(*this);
}

TexelVector FormFactors::surface_share() const { return gather(TexelVector(direct.size(), 1.0)); }

RowSumError row_sum_error(const Transport& transport) {
  const TexelVector share = transport.surface_share();
  RowSumError error;
  double squares = 0;
  std::size_t present = 0;
  for (std::size_t i = 0; i < share.size(); ++i) {
    if (std::isnan(transport.sky_view_factor.values[i])) continue;
    const double left = std::fabs(transport.direct[i] + share[i] - 1);
    error.largest = std::max(error.largest, left);
    squares += left * left;
    ++present;
  }
  if (present > 0) error.rms = std::sqrt(squares / static_cast<double>(present));
  return error;
}

}  // namespace heightlight
