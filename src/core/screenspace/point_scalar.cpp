#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "screenspace/point_kernel.h"

namespace heightlight {
namespace {

using Vec = Eigen::Vector3f;

struct Receiver {
  int row = 0;
  int column = 0;
  float height = 0;
  Vec tangent, bitangent, normal;
};

Receiver make_receiver(const PointPass& pass, int row, int column) {
  const DepthBuffer& depth = pass.depth;
  const std::size_t at = depth.index(row, column);
  Receiver receiver;
  receiver.row = row;
  receiver.column = column;
  receiver.height = depth.heights[at];
  const float n_z = depth.normal_z[at];
  receiver.normal = Vec(-depth.slope_x[at] * n_z, -depth.slope_y[at] * n_z, n_z);
  const Vec& n = receiver.normal;
  Vec t(0.01F * n.y() - n.z(), -0.01F * n.x(), n.x());
  t /= std::sqrt(t.squaredNorm());
  const Vec b = n.cross(t);
  const auto rank = static_cast<std::size_t>(noise_rank(row, column));
  receiver.tangent = pass.turn_cosine[rank] * t + pass.turn_sine[rank] * b;
  receiver.bitangent = pass.turn_cosine[rank] * b - pass.turn_sine[rank] * t;
  return receiver;
}

Vec offset_of(const Receiver& at, const TangentPoint& point) {
  return point.x * at.tangent + point.y * at.bitangent + point.z * at.normal;
}

/// A place in texels from the depth buffer's corner. Beyond an open map's edge it is clamped, as the distance
/// from the edge does not matter there.
struct Place {
  float u = 0, v = 0;
};

Place place_of(const DepthBuffer& depth, const Receiver& at, const Vec& offset) {
  Place place{static_cast<float>(at.column) + offset.x() * static_cast<float>(1 / depth.spacing.x),
              static_cast<float>(at.row) - offset.y() * static_cast<float>(1 / depth.spacing.y)};
  if (depth.boundary == Boundary::open) {
    place.u = std::clamp(place.u, -1.0F, static_cast<float>(depth.width));
    place.v = std::clamp(place.v, -1.0F, static_cast<float>(depth.height));
  }
  return place;
}

int around(float i, int period) {
  const int whole = static_cast<int>(i) % period;
  return whole < 0 ? whole + period : whole;
}

float height_at(const DepthBuffer& depth, const Place& place) {
  const float left = std::floor(place.u);
  const float top = std::floor(place.v);
  const float across = place.u - left;
  const float down = place.v - top;
  const int column = around(left, depth.period_columns);
  const int row = around(top, depth.period_rows);
  const int next_column = column + 1 == depth.period_columns ? 0 : column + 1;
  const int next_row = row + 1 == depth.period_rows ? 0 : row + 1;
  const bool upper_right = across >= down;
  const float corner = depth.heights[depth.index(row, column)];
  const float middle =
      depth.heights[upper_right ? depth.index(row, next_column) : depth.index(next_row, column)];
  const float opposite = depth.heights[depth.index(next_row, next_column)];
  return (1 - std::max(across, down)) * corner + std::fabs(across - down) * middle +
         std::min(across, down) * opposite;
}

/// The map's texel nearest to a place; the place lies below the surface, so that there is one.
std::pair<int, int> texel_at(const DepthBuffer& depth, const Place& place) {
  const int row = around(std::floor(place.v + 0.5F), depth.period_rows);
  const int column = around(std::floor(place.u + 0.5F), depth.period_columns);
  return {std::min(row, depth.height - 1), std::min(column, depth.width - 1)};
}

/// Distance of the first tested place below the surface, as a share of the distance to the point, in (0, 1];
/// 0 where no place is below.
float hidden_share(const PointPass& pass, const Receiver& at, const Vec& offset) {
  for (int test = 1; test <= pass.tests; ++test) {
    const float share = static_cast<float>(test) / static_cast<float>(pass.tests);
    const Vec part = share * offset;
    const float surface = height_at(pass.depth, place_of(pass.depth, at, part)) - at.height;
    if (surface - part.z() >= pass.bias) return share;
  }
  return 0;
}

/// Index of the sky's cell in that direction.
std::size_t cell_of(const SkyGrid& sky, const Vec& way) {
  const float size = std::fabs(way.x()) + std::fabs(way.y()) + std::fabs(way.z());
  const float x = way.x() / std::max(size, 1e-30F);
  const float y = way.y() / std::max(size, 1e-30F);
  const bool below = way.z() < 0;
  const float across = below ? std::copysign(1 - std::fabs(y), x) : x;
  const float down = below ? std::copysign(1 - std::fabs(x), y) : y;
  const auto place = [&](float share) {
    const float half = 0.5F * static_cast<float>(sky.side);
    return std::clamp(static_cast<int>((share + 1) * half), 0, sky.side - 1);
  };
  return static_cast<std::size_t>(place(down)) * static_cast<std::size_t>(sky.side) +
         static_cast<std::size_t>(place(across));
}

}  // namespace

void set_turns(DirectionNoise noise, int frame, PointPass& pass) {
  for (int rank = 0; rank < kNoiseRanks; ++rank) {
    double turn = 0;
    if (noise == DirectionNoise::spatial) turn = static_cast<double>(rank) / kNoiseRanks;
    if (noise == DirectionNoise::temporal) turn = (rank + static_cast<double>(frame) / kFrames) / kNoiseRanks;
    const double angle = 2 * std::numbers::pi * turn;
    pass.turn_cosine[static_cast<std::size_t>(rank)] = static_cast<float>(std::cos(angle));
    pass.turn_sine[static_cast<std::size_t>(rank)] = static_cast<float>(std::sin(angle));
  }
}

void test_points_scalar(const PointPass& pass, int row, PointSums& sums) {
  const DepthBuffer& depth = pass.depth;
  for (int column = 0; column < depth.width; ++column) {
    const Receiver at = make_receiver(pass, row, column);
    const auto j = static_cast<std::size_t>(column);
    for (const TangentPoint& point : pass.points) {
      const Vec offset = offset_of(at, point);
      const float hidden = hidden_share(pass, at, offset);
      if (pass.sky) {
        const std::size_t cell = cell_of(*pass.sky, offset);
        const float counted = (hidden == 0 ? point.weight : 0) + point.kept;
        sums.sky[0][j] += counted * pass.sky->red[cell];
        sums.sky[1][j] += counted * pass.sky->green[cell];
        sums.sky[2][j] += counted * pass.sky->blue[cell];
      }
      if (hidden == 0) {
        sums.open[j] += point.weight;
        continue;
      }
      const Vec part = hidden * offset;
      const auto [i, k] = texel_at(depth, place_of(depth, at, part));
      for (std::size_t a = 0; a < pass.albedos.size(); ++a) {
        sums.albedo[a][j] += point.weight * (*pass.albedos[a])(i, k);
      }
    }
  }
}

void bounce_points_scalar(const BouncePass& pass, int row, std::vector<float>& received) {
  const DepthBuffer& depth = pass.points.depth;
  for (int column = 0; column < depth.width; ++column) {
    const Receiver at = make_receiver(pass.points, row, column);
    for (const TangentPoint& point : pass.points.points) {
      const Vec offset = offset_of(at, point);
      if (hidden_share(pass.points, at, offset) == 0) continue;
      const Place place = place_of(depth, at, offset);
      const auto [i, k] = texel_at(depth, place);
      const float radiance = pass.sender(i, k);
      const Vec way(offset.x(), offset.y(), height_at(depth, place) - at.height);
      const float squared = way.squaredNorm();
      const float n_z = depth.row_normal_z(i, k);
      const float towards =
          n_z * (depth.row_slope_x(i, k) * way.x() + depth.row_slope_y(i, k) * way.y() - way.z());
      const float received_cosine = at.normal.dot(way);
      const float clamped = std::max(squared, pass.least_distance * pass.least_distance);
      const float cosines =
          std::max(towards, 0.0F) * std::max(received_cosine, 0.0F) / std::max(squared, 1e-30F);
      const float all = radiance * pass.area * cosines / clamped;
      // Beside a hole the nearest texel may have no radiance; it does not count.
      if (!std::isnan(all)) received[static_cast<std::size_t>(column)] += all;
    }
  }
}

}  // namespace heightlight
