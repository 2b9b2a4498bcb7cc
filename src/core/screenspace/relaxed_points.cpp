#include "screenspace/relaxed_points.h"

#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "base/hash.h"

namespace heightlight {
namespace {

constexpr int kGrid = 24;        // places along each axis by which cells are measured
constexpr int kIterations = 40;  // after these, points move by less than the spacing of the places

using Points = std::vector<Eigen::Vector3d>;

Points random_points(int count) {
  Points points;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    points.emplace_back(unit_real(scramble(3 * i)), unit_real(scramble(3 * i + 1)),
                        unit_real(scramble(3 * i + 2)));
  }
  return points;
}

/// Vector from a point to a place, around x in the shorter direction.
Eigen::Vector3d way_to(const Eigen::Vector3d& place, const Eigen::Vector3d& point) {
  Eigen::Vector3d way = place - point;
  way.x() -= std::round(way.x());
  return way;
}

/// Moves each point to the mean of the places that are nearest to it.
void relax(Points& points) {
  Points sums(points.size(), Eigen::Vector3d::Zero());
  std::vector<int> counts(points.size());
  for (int cell = 0; cell < kGrid * kGrid * kGrid; ++cell) {
    const Eigen::Vector3i along(cell % kGrid, cell / kGrid % kGrid, cell / (kGrid * kGrid));
    const Eigen::Vector3d place = (along.cast<double>().array() + 0.5) / kGrid;
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double distance = way_to(place, points[i]).squaredNorm();
      if (distance >= least) continue;
      least = distance;
      nearest = i;
    }
    sums[nearest] += way_to(place, points[nearest]);
    ++counts[nearest];
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (counts[i] > 0) points[i] += sums[i] / counts[i];
    points[i].x() -= std::floor(points[i].x());
  }
}

}  // namespace

const std::vector<Eigen::Vector3d>& relaxed_points(int count) {
  static std::mutex mutex;
  static std::map<int, Points> known;
  const std::lock_guard lock(mutex);
  const auto [entry, is_new] = known.try_emplace(count);
  if (is_new) {
    entry->second = random_points(count);
    for (int i = 0; i < kIterations; ++i) relax(entry->second);
  }
  return entry->second;
}

}  // namespace heightlight
