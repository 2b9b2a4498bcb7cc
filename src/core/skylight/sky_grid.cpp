#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "heightlight/sky_light.h"
#include "skylight/sky_samples.h"

namespace heightlight {
namespace {

constexpr int kSide = 64;   // cells of some 3 × 10⁻³ sr
constexpr int kRows = 128;  // rows of the directions that cells are averaged from

/// Unit direction of the middle of a cell.
Eigen::Vector3f cell_direction(int row, int column) {
  const auto middle = [](int i) { return (2 * static_cast<float>(i) + 1) / kSide - 1; };
  Eigen::Vector3f way(middle(column), middle(row), 0);
  way.z() = 1 - std::fabs(way.x()) - std::fabs(way.y());
  if (way.z() < 0) {  // folded over the edges of the upper half
    const Eigen::Vector3f folded = way;
    way.x() = std::copysign(1 - std::fabs(folded.y()), folded.x());
    way.y() = std::copysign(1 - std::fabs(folded.x()), folded.y());
  }
  return way.normalized();
}

}  // namespace

SkyGrid make_sky_grid(const SkyLight& sky, double solid_angle) {
  if (!(solid_angle > 0 && solid_angle <= 2 * std::numbers::pi))
    throw UsageError("a sky is averaged over a solid angle in (0, 2π]");
  const std::vector<SkySample> samples = sample_sky(sky, kRows);
  const auto least_cosine = static_cast<float>(1 - solid_angle / (2 * std::numbers::pi));
  SkyGrid grid;
  grid.side = kSide;
  for (std::vector<float>* channel : {&grid.red, &grid.green, &grid.blue})
    channel->resize(std::size_t{kSide} * kSide);
  parallel_for(kSide, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < kSide; ++column) {
      const Eigen::Vector3f way = cell_direction(row, column);
      Eigen::Vector3f mean = as_eigen(radiance_from(sky, to_vector3(way)));
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double all = 0;
      for (const SkySample& sample : samples) {
        if (as_eigen(sample.direction).dot(way) < least_cosine) continue;
        all += double{sample.solid_angle};
        sum += double{sample.solid_angle} * as_eigen(sample.radiance).cast<double>();
      }
      if (all > 0) mean = (sum / all).cast<float>();
      const auto cell = static_cast<std::size_t>(row) * kSide + static_cast<std::size_t>(column);
      grid.red[cell] = mean.x();
      grid.green[cell] = mean.y();
      grid.blue[cell] = mean.z();
    }
  });
  return grid;
}

}  // namespace heightlight
