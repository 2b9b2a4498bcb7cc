#include "transport/walked_bounces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "base/texels.h"
#include "transport/progressive_gather.h"

namespace heightlight {
namespace {

/// Light of less than this share of the error wanted is not walked for.
constexpr double kNegligible = 1e-2;

/// Bounces that leave more than this of what was left fall slowly.
constexpr double kSlow = 0.5;

/// Azimuths of a bounce, at least, and of any receiver that walks: late bounces are shown on a logarithmic
/// scale.
constexpr int kFewest = 4;
constexpr int kFewestAnywhere = 2;

/// A field whose square varies by less than this share is one value.
constexpr double kOneValue = 1e-12;

/// Rows from one to the next that fields are compared on.
constexpr int kRowStep = 4;

/// A power of two near the brightest light: what single precision holds is in units of it.
double unit_of(const TexelVector& x) {
  int exponent = 0;
  std::frexp(as_eigen(x).cwiseAbs().maxCoeff(), &exponent);
  return std::ldexp(1.0, std::max(exponent, -1000));
}

}  // namespace

WalkedBounces::WalkedBounces(std::shared_ptr<const MapGather> gather, const Transport& transport,
                             const BounceWalk& walk, const Watch& watch)
    : gather_(std::move(gather)),
      transport_(transport),
      walk_(walk),
      watch_(watch),
      before_(transport.direct.size()),
      sums_(transport.sky_view_factor.width, transport.sky_view_factor.height) {}

TexelVector WalkedBounces::next(const TexelVector& last, const TexelVector& sum) {
  ++bounce_;
  if (follows_rest_) {
    TexelVector rest = to_texels((1 - as_eigen(sum).array()).max(0.0).matrix());
    const Likeness likeness = compare_with_before(rest);
    if (bounce_ == 1 || likeness.ratio <= kSlow) {
      const TexelVector next_rest = follow(rest, likeness);
      for_texels(transport_.sky_view_factor, [&](std::size_t i) {
        rest[i] =
            std::isnan(transport_.sky_view_factor.values[i]) ? 0 : std::max(rest[i] - next_rest[i], 0.0);
      });
      return rest;
    }
    follows_rest_ = false;
    azimuths_ = 0;
  }
  return follow(last, compare_with_before(last));
}

TexelVector WalkedBounces::follow(const TexelVector& field, const Likeness& likeness) {
  const bool negligible = bounce_ > 2 && likeness.size < kNegligible * walk_.error;
  TexelVector next = negligible ? to_texels(likeness.ratio * as_eigen(field)) : walk(field, likeness);
  before_ = field;
  mean_before_ = likeness.mean;
  return next;
}

/// Row by row, so that sums are the same for any number of threads.
WalkedBounces::Likeness WalkedBounces::compare_with_before(const TexelVector& field) const {
  const Map& sky = transport_.sky_view_factor;
  const Image<Vector3>& normal = gather_->surface().normal;
  using Sums = Eigen::Matrix<double, 6, 1>;
  std::vector<Sums> rows(static_cast<std::size_t>((sky.height + kRowStep - 1) / kRowStep));
  parallel_for(static_cast<std::int64_t>(rows.size()), [&](std::int64_t row) {
    Sums sums = Sums::Zero();
    const std::size_t begin = sky.index(static_cast<int>(row) * kRowStep, 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(sky.width); ++i) {
      if (std::isnan(sky.values[i])) continue;
      const double weight = (1 - transport_.direct[i]) / double{normal.values[i].z};
      const double x = field[i];
      const double y = before_[i];
      sums += weight * Sums{1, x, y, x * x, x * y, y * y};
    }
    rows[static_cast<std::size_t>(row)] = sums;
  });
  Sums sums = Sums::Zero();
  for (const Sums& row : rows) sums += row;
  if (!(sums(0) > 0)) return {};
  sums /= sums(0);
  const double spread = sums(5) - sums(2) * sums(2);
  return {.mean = sums(1),
          .size = std::sqrt(sums(3)),
          .ratio = sums(5) > 0 ? sums(4) / sums(5) : 0,
          .of_deviations = spread > kOneValue * sums(5) ? (sums(4) - sums(1) * sums(2)) / spread : 0};
}

TexelVector WalkedBounces::walk(const TexelVector& field, const Likeness& likeness) {
  const int azimuths = even_azimuths(std::max(walk_.azimuths / bounce_, std::min(walk_.azimuths, kFewest)));
  const double walked = kFading * azimuths_;
  azimuths_ = walked + azimuths;
  const double kept = walked / azimuths_ * likeness.of_deviations;
  const double unit = unit_of(field);
  const auto kept_sum = static_cast<float>(kept * unit_ / unit);
  unit_ = unit;
  const Map& sky = transport_.sky_view_factor;
  Map deviation(sky.width, sky.height);
  for_texels(deviation, [&](std::size_t i) {
    const double value = (field[i] - likeness.mean) - kept * (before_[i] - mean_before_);
    deviation.values[i] = std::isnan(sky.values[i]) ? sky.values[i] : static_cast<float>(value / unit);
  });
  FieldPyramid pyramid = gather_->make_pyramid();
  pyramid.fill(deviation);
  TexelVector next(field.size());
  gather_->run(
      {.azimuths = azimuths, .turn = spread_turn(bounce_), .sky = &sky, .fewest = kFewestAnywhere},
      {&pyramid},
      [&](const ReceiverTile& tile, const GatherSums& sums) {
        for_present(tile, [&](std::size_t at, int row, int column) {
          const std::size_t i = sky.index(row, column);
          float& sum = sums_.values[i];
          sum = sums.weighted[0][at] + kept_sum * sum;
          next[i] = std::max((1 - transport_.direct[i]) * likeness.mean + unit * double{sum}, 0.0);
        });
      },
      watch_);
  return next;
}

}  // namespace heightlight
