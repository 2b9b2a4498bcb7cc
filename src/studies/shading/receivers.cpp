#include "shading/receivers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bake/bent_cone.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/screenspace.h"
#include "heightlight/solve.h"
#include "visibility/exact_sky.h"

namespace heightlight {
namespace {

Eigen::Vector3d bent_or_normal(const Eigen::Vector3d& bent, const Eigen::Vector3d& normal) {
  return bent.norm() > 0 ? Eigen::Vector3d(bent.normalized()) : normal;
}

OpennessSource find_baked_openness(const Surface& surface, const ReceiverGrid& grid, std::uint64_t memory,
                                   const Watch& watch) {
  Request request;
  request.wanted.sky = request.wanted.moments.first = request.wanted.moments.second = true;
  request.checks.sky = false;
  request.limits.memory = memory;
  request.watch = watch;
  const Results found = solve(surface, request);
  OpennessSource source{.name = kBakedOpenness};
  for (const std::size_t texel : grid.texels) {
    const auto sky = static_cast<double>(found.sky_view_factor.values[texel]);
    const Eigen::Vector3d first = as_eigen(found.moments.first.values[texel]).cast<double>();
    std::array<double, 5> second{};
    for (std::size_t k = 0; k < second.size(); ++k)
      second.at(k) = static_cast<double>(found.moments.second.values[texel].at(k));
    source.receivers.push_back({sky, bent_or_normal(first, normal_at(surface, texel)),
                                cone_of_spread(sky, found.moments.first.values[texel])});
    source.harmonics.push_back(harmonics_of_moments(sky, first, second));
  }
  return source;
}

OpennessSource find_gtao_openness(const Surface& surface, const ReceiverGrid& grid) {
  const DepthBuffer depth = make_depth_buffer(surface);
  const double radius = depth.relief > 0 ? std::min(depth.relief, largest_radius(depth))
                                         : std::numeric_limits<double>::infinity();
  const ScreenSpaceView found = gtao(depth, {.radius = radius, .bent_normal = true});
  OpennessSource source{.name = kGtaoOpenness};
  for (const std::size_t texel : grid.texels) {
    source.receivers.push_back({static_cast<double>(found.sky_view_factor.values[texel]),
                                as_eigen(found.bent_normal.values[texel]).cast<double>().normalized(),
                                std::numeric_limits<double>::quiet_NaN()});
  }
  return source;
}

}  // namespace

ReceiverGrid pick_receiver_grid(const Surface& surface, int most, std::uint64_t seed) {
  const int longest = std::max(surface.width(), surface.height());
  const int stride = (longest + most - 1) / most;
  ReceiverGrid grid{.columns = (surface.width() + stride - 1) / stride,
                    .rows = (surface.height() + stride - 1) / stride};
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::uint64_t hash =
          hash_combine(seed, static_cast<std::uint64_t>(row) << 32 | static_cast<std::uint64_t>(column));
      const auto inside = [stride](std::uint64_t value) {
        return static_cast<int>(value % static_cast<std::uint64_t>(stride));
      };
      grid.texels.push_back(
          surface.map.height.index(std::min(row * stride + inside(hash), surface.height() - 1),
                                   std::min(column * stride + inside(hash >> 32), surface.width() - 1)));
    }
  }
  return grid;
}

ReceiverGrid pick_receiver_window(const Surface& surface, int most) {
  ReceiverGrid window{.columns = std::min(surface.width(), most), .rows = std::min(surface.height(), most)};
  const int top = (surface.height() - window.rows) / 2;
  const int left = (surface.width() - window.columns) / 2;
  for (int row = 0; row < window.rows; ++row) {
    for (int column = 0; column < window.columns; ++column)
      window.texels.push_back(surface.map.height.index(top + row, left + column));
  }
  return window;
}

OpennessSource find_exact_openness(const Surface& surface, const ReceiverGrid& grid, const Watch& watch) {
  const ExactWalker walker(surface, kOpennessAzimuths);
  OpennessSource source{.name = kExactOpenness, .receivers = std::vector<Openness>(grid.texels.size())};
  source.harmonics.resize(grid.texels.size());
  Progress progress("exact openness", static_cast<std::int64_t>(grid.texels.size()), watch);
  parallel_for(
      static_cast<std::int64_t>(grid.texels.size()),
      [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(i);
        const auto width = static_cast<std::size_t>(surface.width());
        const ExactSky sky = find_exact_sky(walker, static_cast<int>(grid.texels[at] / width),
                                            static_cast<int>(grid.texels[at] % width));
        source.receivers[at] = {sky.sky_view_factor,
                                bent_or_normal(sky.first, normal_at(surface, grid.texels[at])),
                                cone_of_spread(sky.sky_view_factor, to_vector3(sky.first.cast<float>()))};
        source.harmonics[at] = harmonics_of_moments(sky.sky_view_factor, sky.first, sky.second);
      },
      &progress);
  return source;
}

std::vector<OpennessSource> find_openness(const Surface& surface, const ReceiverGrid& grid,
                                          std::uint64_t memory, const Watch& watch) {
  return {find_exact_openness(surface, grid, watch), find_baked_openness(surface, grid, memory, watch),
          find_gtao_openness(surface, grid)};
}

Eigen::Vector3d normal_at(const Surface& surface, std::size_t texel) {
  return as_eigen(surface.normal.values[texel]).cast<double>().normalized();
}

}  // namespace heightlight
