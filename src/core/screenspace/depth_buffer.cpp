#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "heightlight/screenspace.h"
#include "screenspace/slice_samples.h"

namespace heightlight {
namespace {

int torus_period(int samples, Boundary boundary) {
  return boundary == Boundary::tile ? samples : 2 * samples;
}

int phase_stride(int period_columns) { return period_columns / DepthBuffer::kPhases + 1 + kMostReceivers; }

void fill_heights(const Surface& surface, DepthBuffer& depth) {
  depth.heights.assign(static_cast<std::size_t>(depth.period_rows) * DepthBuffer::kPhases *
                           static_cast<std::size_t>(depth.stride),
                       kNoDepth);
  parallel_for(depth.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < depth.stride * DepthBuffer::kPhases; ++column) {
      const int source = column % depth.period_columns;
      const float height = source < depth.width ? surface.map.height(row, source) : kNoDepth;
      depth.heights[depth.index(row, column)] = std::isnan(height) ? kNoDepth : height;
    }
  });
}

void fill_receivers(const Surface& surface, DepthBuffer& depth) {
  const auto size =
      static_cast<std::size_t>(depth.height) * DepthBuffer::kPhases * static_cast<std::size_t>(depth.stride);
  depth.slope_x.assign(size, 0.0F);
  depth.slope_y.assign(size, 0.0F);
  depth.normal_z.assign(size, 1.0F);
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  depth.row_height = surface.map.height;
  depth.row_slope_x = depth.row_slope_y = depth.row_normal_z = Map(depth.width, depth.height, kMissing);
  parallel_for(depth.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < depth.width; ++column) {
      const Vector3& normal = surface.normal(row, column);
      if (std::isnan(normal.z)) continue;
      const std::size_t at = depth.index(row, column);
      depth.row_slope_x(row, column) = depth.slope_x[at] = -normal.x / normal.z;
      depth.row_slope_y(row, column) = depth.slope_y[at] = -normal.y / normal.z;
      depth.row_normal_z(row, column) = depth.normal_z[at] = normal.z;
    }
  });
}

}  // namespace

std::uint64_t depth_buffer_bytes(int width, int height, Boundary boundary) {
  const auto stride = static_cast<std::uint64_t>(phase_stride(torus_period(width, boundary)));
  const auto rows = static_cast<std::uint64_t>(torus_period(height, boundary) + 3 * height);
  const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return sizeof(float) * (rows * DepthBuffer::kPhases * stride + 4 * texels);
}

DepthBuffer make_depth_buffer(const Surface& surface) {
  DepthBuffer depth;
  depth.width = surface.width();
  depth.height = surface.height();
  depth.boundary = surface.map.boundary;
  depth.period_columns = torus_period(depth.width, depth.boundary);
  depth.period_rows = torus_period(depth.height, depth.boundary);
  depth.stride = phase_stride(depth.period_columns);
  depth.spacing = surface.map.spacing;
  depth.relief = relief(surface.map);
  fill_heights(surface, depth);
  fill_receivers(surface, depth);
  return depth;
}

double largest_radius(const DepthBuffer& depth) {
  constexpr double kLeastSlope = 0.004;
  const double across = depth.width * depth.spacing.x;
  const double down = depth.height * depth.spacing.y;
  if (depth.boundary == Boundary::open) return std::hypot(across, down);
  const double texel = std::max(depth.spacing.x, depth.spacing.y);
  return std::clamp(depth.relief / kLeastSlope, texel, std::max(texel, 4 * std::max(across, down)));
}

}  // namespace heightlight
