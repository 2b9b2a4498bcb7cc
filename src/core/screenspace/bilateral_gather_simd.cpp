// The lanes hold neighbouring texels of a row. The arithmetic is the same as in bilateral_gather_scalar.cpp,
// which also handles the row's ends.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "screenspace/bilateral_gather.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screenspace/bilateral_gather_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 8>;
using VF = hn::Vec<F>;
constexpr F kF;
constexpr int kWindow = kGatherBefore + 1 + kGatherAfter;

/// Rows of the window around a row; −1 where there is none.
std::array<int, kWindow> window_rows(const DepthBuffer& depth, int row) {
  std::array<int, kWindow> rows{};
  for (int i = 0; i < kWindow; ++i) {
    int at = row + i - kGatherBefore;
    if (at < 0 || at >= depth.height) {
      at = depth.boundary == Boundary::tile ? ((at % depth.height) + depth.height) % depth.height : -1;
    }
    rows[static_cast<std::size_t>(i)] = at;
  }
  return rows;
}

constexpr std::size_t kMostResults = 6;  // three sums and a bent normal

/// Means for the receivers from `column` on, whose windows all lie inside the row.
HWY_INLINE void gather_lanes_at(const GatherPass& pass, const std::array<int, kWindow>& rows, int row,
                                int column, std::vector<Map>& means) {
  const DepthBuffer& depth = pass.depth;
  const std::size_t here = depth.row_height.index(row, column);
  const VF height = hn::LoadU(kF, depth.row_height.values.data() + here);
  const VF slope_x = hn::LoadU(kF, depth.row_slope_x.values.data() + here);
  const VF slope_y = hn::LoadU(kF, depth.row_slope_y.values.data() + here);
  const VF normal_z = hn::LoadU(kF, depth.row_normal_z.values.data() + here);
  const VF tolerance = hn::Set(kF, pass.tolerance);
  const VF least_cosine = hn::Set(kF, pass.cosine);
  VF count = hn::Zero(kF);
  std::array<VF, kMostResults> sums;
  for (std::size_t c = 0; c < means.size(); ++c) sums[c] = hn::Zero(kF);
  for (int i = 0; i < kWindow; ++i) {
    const int from = rows[static_cast<std::size_t>(i)];
    if (from < 0) continue;
    const VF y = hn::Set(kF, static_cast<float>(-(i - kGatherBefore) * depth.spacing.y));
    for (int right = -kGatherBefore; right <= kGatherAfter; ++right) {
      const VF x = hn::Set(kF, static_cast<float>(right * depth.spacing.x));
      const std::size_t there = depth.row_height.index(from, column + right);
      const VF plane = hn::Add(hn::Mul(slope_x, x), hn::Mul(slope_y, y));
      const VF above = hn::Sub(hn::Sub(hn::LoadU(kF, depth.row_height.values.data() + there), height), plane);
      const VF level = hn::Add(hn::Mul(slope_x, hn::LoadU(kF, depth.row_slope_x.values.data() + there)),
                               hn::Mul(slope_y, hn::LoadU(kF, depth.row_slope_y.values.data() + there)));
      const VF cosine = hn::Mul(hn::Mul(normal_z, hn::LoadU(kF, depth.row_normal_z.values.data() + there)),
                                hn::Add(level, hn::Set(kF, 1.0F)));
      const auto is_near = hn::Le(hn::Mul(hn::Abs(above), normal_z), tolerance);  // false for NaN
      const auto counts = hn::And(is_near, hn::Ge(cosine, least_cosine));
      count = hn::Add(count, hn::IfThenElseZero(counts, hn::Set(kF, 1.0F)));
      for (std::size_t c = 0; c < means.size(); ++c) {
        const VF result = hn::LoadU(kF, pass.results[c].values.data() + there);
        sums[c] = hn::Add(sums[c], hn::IfThenElseZero(counts, result));
      }
    }
  }
  // A missing receiver counts no neighbour, not even itself: 0 / 0 is NaN.
  for (std::size_t c = 0; c < means.size(); ++c) {
    hn::StoreU(hn::Div(sums[c], count), kF, means[c].values.data() + here);
  }
}

void gather_lanes(const GatherPass& pass, int row, std::vector<Map>& means) {
  assert(means.size() <= kMostResults);
  const int lanes = static_cast<int>(hn::Lanes(kF));
  const std::array<int, kWindow> rows = window_rows(pass.depth, row);
  const int last = pass.depth.width - kGatherAfter - lanes;  // the last column where a vector may begin
  int column = kGatherBefore;
  for (; column <= last; column += lanes) gather_lanes_at(pass, rows, row, column, means);
  gather_row_scalar(pass, row, 0, std::min(kGatherBefore, pass.depth.width), means);
  gather_row_scalar(pass, row, std::min(column, pass.depth.width), pass.depth.width, means);
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(gather_lanes);

void gather_row(const GatherPass& pass, int row, std::vector<Map>& means) {
  HWY_DYNAMIC_DISPATCH(gather_lanes)(pass, row, means);
}

}  // namespace heightlight
#endif
