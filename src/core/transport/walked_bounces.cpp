#include "transport/walked_bounces.h"

#include <algorithm>
#include <cmath>

#include "base/texel_algebra.h"
#include "base/texels.h"
#include "transport/progressive_gather.h"
#include "transport/seen_places.h"

namespace heightlight {
namespace {

/// A field smaller than this share of the error wanted is not walked for.
constexpr double kNegligible = 1e-2;

/// Bounces that leave more than this share of what was left fall slowly.
constexpr double kSlow = 0.5;

/// Fewest azimuths of a bounce, and fewest of any receiver that walks. There must be some for late bounces
/// too, which are shown on a logarithmic scale.
constexpr int kFewest = 4;
constexpr int kFewestAnywhere = 2;

/// A field whose variance is less than this share of its mean square counts as constant.
constexpr double kOneValue = 1e-12;

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
  // Before the first walk of this sequence the field before is another one, and gives no ratio.
  const bool negligible = azimuths_ > 0 && likeness.size < kNegligible * walk_.error;
  TexelVector next = negligible ? to_texels(likeness.ratio * as_eigen(field)) : walk(field, likeness);
  before_ = field;
  mean_before_ = likeness.mean;
  return next;
}

WalkedBounces::Likeness WalkedBounces::compare_with_before(const TexelVector& field) const {
  double weights = 0;
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for_seen_places(transport_.sky_view_factor, gather_->surface(),
                  [&](std::size_t i, double share, double area) {
                    const double weight = share * area;
                    weights += weight;
                    x += weight * field[i];
                    y += weight * before_[i];
                    xx += weight * field[i] * field[i];
                    xy += weight * field[i] * before_[i];
                    yy += weight * before_[i] * before_[i];
                  });
  if (!(weights > 0)) return {};
  const double spread = yy - y * y / weights;
  return {.mean = x / weights,
          .size = std::sqrt(xx / weights),
          .ratio = yy > 0 ? xy / yy : 0,
          .of_deviations = spread > kOneValue * yy ? (xy - x * y / weights) / spread : 0};
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
