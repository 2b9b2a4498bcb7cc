#include <algorithm>
#include <cmath>
#include <numbers>

#include "screenspace/gtao_kernel.h"

namespace heightlight {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2;

/// A receiver with its tangent plane and its normal's z.
struct Receiver {
  int row = 0;
  int column = 0;
  float height = 0, slope_x = 0, slope_y = 0, normal_z = 1;
};

/// Slope under which the receiver sees a sample.
float sample_slope(const GtaoPass& pass, const SliceSample& sample, const Receiver& at) {
  const DepthBuffer& depth = pass.depth;
  float slope = 0;
  for (int i = 0; i < pass.tables.taps; ++i) {
    const DepthTap& tap = sample.taps[static_cast<std::size_t>(i)];
    const int row = (at.row + tap.row) % depth.period_rows;
    const int column = (at.column + tap.column) % depth.period_columns;
    slope += tap.weight * (depth.heights[depth.index(row, column)] - at.height);
  }
  return slope;
}

float highest_slope(const GtaoPass& pass, const std::vector<SliceSample>& side, const Receiver& at) {
  float highest = -kSteepestSlope;
  for (const SliceSample& sample : side) highest = std::max(highest, sample_slope(pass, sample, at));
  return highest;
}

/// Lines 18 to 25 with the falloff of section 4.3 and eq. 13; returns the slope of the resulting cosine.
float attenuated_slope(const GtaoPass& pass, const std::vector<SliceSample>& side, const Receiver& at) {
  float horizon = -1;
  for (const SliceSample& sample : side) {
    const float slope = std::max(sample_slope(pass, sample, at), -kSteepestSlope);
    const float secant = std::sqrt(slope * slope + 1);
    const float near = std::clamp((pass.radius - sample.distance * secant) * pass.per_falloff, 0.0F, 1.0F);
    const float cosine = near * (slope / secant + 1) - 1;
    horizon = cosine >= horizon ? cosine : std::max(horizon - pass.thickness, -1.0F);
  }
  return horizon / std::sqrt(std::max(1 - horizon * horizon, 1e-12F));
}

struct Side {
  float sky, solid, along, up;
};

Side integrate_side(float c, float n_z, float m) {
  const float q = 1 / (1 + m * m);
  const float cosine = std::sqrt(q);
  const float s = m * cosine;
  const float e = 1 - s;
  const float cubed_cosine = e * e * (2 + s);
  const float mixed = q * cosine;
  return {c * (kHalfPi - std::atan(m) - m * q) + n_z * q, e, c * cubed_cosine + n_z * mixed,
          c * mixed + n_z * e * (1 + s + s * s)};
}

void look_around(const GtaoPass& pass, const Receiver& at, GtaoSums& sums) {
  const auto j = static_cast<std::size_t>(at.column);
  for (const Slice& slice : pass.tables.table(at.row, at.column % DepthBuffer::kPhases)) {
    for (std::size_t side = 0; side < 2; ++side) {
      const float sign = side == 0 ? -1.0F : 1.0F;
      const float tangent = sign * (at.slope_x * slice.x + at.slope_y * slice.y);
      const float c = -at.normal_z * tangent;
      const float found = pass.attenuated ? attenuated_slope(pass, slice.sides[side], at)
                                          : highest_slope(pass, slice.sides[side], at);
      const Side part = integrate_side(c, at.normal_z, std::max(found, tangent));
      sums.sky[j] += part.sky;
      if (!sums.solid.empty()) sums.solid[j] += part.solid;
      if (!sums.open.empty()) sums.open[j] += integrate_side(c, at.normal_z, tangent).sky;
      if (sums.bent[0].empty()) continue;
      sums.bent[0][j] += sign * slice.x * part.along;
      sums.bent[1][j] += sign * slice.y * part.along;
      sums.bent[2][j] += part.up;
    }
  }
}

}  // namespace

void gtao_row_scalar(const GtaoPass& pass, int row, GtaoSums& sums) {
  const DepthBuffer& depth = pass.depth;
  for (int column = 0; column < depth.width; ++column) {
    const std::size_t at = depth.index(row, column);
    look_around(pass,
                {row, column, depth.heights[at], depth.slope_x[at], depth.slope_y[at], depth.normal_z[at]},
                sums);
  }
}

}  // namespace heightlight
