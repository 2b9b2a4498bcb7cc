#include "bake/blue_noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/hash.h"

namespace heightlight {
namespace {

constexpr double kSigma = 1.5;

/// Points on a wrapped square, and at every place the sum of Gaussians around them.
class PointEnergy {
 public:
  explicit PointEnergy(int side)
      : side_(side), gauss_(static_cast<std::size_t>(side)), points_(side, side), energy_(side, side) {
    for (int i = 0; i < side; ++i) {
      const int away = std::min(i, side - i);
      gauss_[static_cast<std::size_t>(i)] = std::exp(-away * away / (2 * kSigma * kSigma));
    }
  }

  void flip(std::size_t place) {
    const bool was = points_.values[place] != 0;
    points_.values[place] = was ? 0 : 1;
    const int row = static_cast<int>(place) / side_;
    const int column = static_cast<int>(place) % side_;
    for (int i = 0; i < side_; ++i) {
      const double down = gauss_[static_cast<std::size_t>((i - row + side_) % side_)];
      for (int j = 0; j < side_; ++j) {
        const double share = down * gauss_[static_cast<std::size_t>((j - column + side_) % side_)];
        energy_(i, j) += was ? -share : share;
      }
    }
  }

  /// The point with the most energy.
  std::size_t tightest_cluster() const {
    std::size_t best = points_.size();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_.values[i] && (best == points_.size() || energy_.values[i] > energy_.values[best])) best = i;
    }
    return best;
  }

  /// The place without a point that has the least energy.
  std::size_t largest_void() const {
    std::size_t best = points_.size();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!points_.values[i] && (best == points_.size() || energy_.values[i] < energy_.values[best]))
        best = i;
    }
    return best;
  }

  const Image<std::uint8_t>& points() const { return points_; }

 private:
  int side_;
  std::vector<double> gauss_;
  Image<std::uint8_t> points_;  ///< 1 where one is
  Image<double> energy_;
};

/// A tenth of the places, moved from clusters into voids until nothing moves any more.
PointEnergy make_prototype(int side, std::uint64_t seed) {
  PointEnergy points(side);
  const std::size_t places = points.points().size();
  std::size_t count = 0;
  for (std::uint64_t i = 0; count < places / 10; ++i) {
    const std::size_t place = hash_combine(seed, i) % places;
    if (points.points().values[place]) continue;
    points.flip(place);
    ++count;
  }
  // Rounding may leave two places taking turns; no more moves than places are ever needed.
  for (std::size_t moves = 0; moves < places; ++moves) {
    const std::size_t from = points.tightest_cluster();
    points.flip(from);
    const std::size_t to = points.largest_void();
    points.flip(to);
    if (to == from) break;
  }
  return points;
}

}  // namespace

Image<float> make_blue_noise(int side, std::uint64_t seed) {
  const PointEnergy prototype = make_prototype(side, seed);
  const auto places = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  Image<float> thresholds(side, side);
  const auto set = [&](std::size_t place, std::size_t rank) {
    thresholds.values[place] = (static_cast<float>(rank) + 0.5F) / static_cast<float>(places);
  };
  const auto begun = static_cast<std::size_t>(
      std::count(prototype.points().values.begin(), prototype.points().values.end(), std::uint8_t{1}));
  PointEnergy points = prototype;
  for (std::size_t rank = begun; rank-- > 0;) {
    const std::size_t place = points.tightest_cluster();
    points.flip(place);
    set(place, rank);
  }
  points = prototype;
  for (std::size_t rank = begun; rank < places; ++rank) {
    const std::size_t place = points.largest_void();
    points.flip(place);
    set(place, rank);
  }
  return thresholds;
}

}  // namespace heightlight
