#include "ray_lattice.h"

#include <algorithm>
#include <cmath>

namespace heightlight {
namespace {

struct Ray {
  std::array<float, 3> direction;
  float weight;
};

using RayIterator = std::vector<Ray>::iterator;

float side(RayIterator begin, RayIterator end, std::size_t axis) {
  const auto [low, high] = std::minmax_element(
      begin, end, [axis](const Ray& a, const Ray& b) { return a.direction[axis] < b.direction[axis]; });
  return high->direction[axis] - low->direction[axis];
}

/// Sorts directions into clusters of eight, by halving the longest side of their bounding box again and
/// again.
void cluster(RayIterator begin, RayIterator end) {
  constexpr std::ptrdiff_t kCluster = 8;
  if (end - begin <= kCluster) return;
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (side(begin, end, axis) > side(begin, end, longest)) longest = axis;
  }
  const std::ptrdiff_t half_clusters = ((end - begin) / 2 + kCluster - 1) / kCluster;
  const RayIterator middle = begin + half_clusters * kCluster;
  std::nth_element(begin, middle, end, [longest](const Ray& a, const Ray& b) {
    return a.direction[longest] < b.direction[longest];
  });
  cluster(begin, middle);
  cluster(middle, end);
}

RayLattice make_lattice(const HemisphereDirections& directions, std::size_t table, RayDensity density) {
  std::vector<Ray> rays(static_cast<std::size_t>(directions.count));
  for (std::size_t k = 0; k < rays.size(); ++k) {
    float cosine = directions.cosine[table][k];
    float weight = static_cast<float>(directions.weight[table][k]);
    if (density == RayDensity::cosine) {  // converts uniform cosθ in [0, 1] to uniform cos²θ
      cosine = std::sqrt(cosine);
      weight = 1.0F / static_cast<float>(directions.count);
    }
    const float sine = std::sqrt(1 - cosine * cosine);
    rays[k] = {{sine * directions.azimuth_cosine[k], sine * directions.azimuth_sine[k], cosine}, weight};
  }
  cluster(rays.begin(), rays.end());
  while (rays.size() % kLatticePadding != 0) rays.push_back({rays.back().direction, 0});
  RayLattice lattice;
  for (const Ray& ray : rays) {
    lattice.x.push_back(ray.direction[0]);
    lattice.y.push_back(ray.direction[1]);
    lattice.z.push_back(ray.direction[2]);
    lattice.weight.push_back(ray.weight);
  }
  return lattice;
}

}  // namespace

std::array<RayLattice, HemisphereDirections::kTables> make_ray_lattices(
    const HemisphereDirections& directions, RayDensity density) {
  std::array<RayLattice, HemisphereDirections::kTables> lattices;
  for (std::size_t table = 0; table < lattices.size(); ++table) {
    lattices[table] = make_lattice(directions, table, density);
  }
  return lattices;
}

}  // namespace heightlight
