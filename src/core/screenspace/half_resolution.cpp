#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "heightlight/screenspace.h"
#include "screenspace/bilateral_gather.h"

// Jimenez et al. 2016, section 4.3: occlusion at half resolution, "bilaterally upscaled to full resolution".
// Of every 2 × 2 texels the depth and the normal of the upper left one are kept. At full resolution a texel
// takes the mean, by bilinear weights, of those among the four nearest results that lie on its own surface;
// of all four where none does.

namespace heightlight {
namespace {

/// Takes texels of the half-resolution buffer to full resolution (`source`) and back (`place`), along one
/// axis.
struct Halving {
  int full = 1;
  int half = 1;

  explicit Halving(int size) : full(size), half(std::max(1, size / 2)) {}
  int source(int i) const { return static_cast<int>(std::int64_t{i} * full / half); }
  double place(int i) const { return static_cast<double>(i) * half / full; }
};

Surface pick_quarter(const DepthBuffer& depth) {
  const Halving columns(depth.width);
  const Halving rows(depth.height);
  Surface quarter;
  quarter.map.height = Image<float>(columns.half, rows.half);
  quarter.map.boundary = depth.boundary;
  quarter.map.spacing = {depth.spacing.x * depth.width / columns.half,
                         depth.spacing.y * depth.height / rows.half};
  quarter.normal = Image<Vector3>(columns.half, rows.half);
  for (int row = 0; row < rows.half; ++row) {
    for (int column = 0; column < columns.half; ++column) {
      const int i = rows.source(row);
      const int j = columns.source(column);
      const float z = depth.row_normal_z(i, j);
      quarter.map.height(row, column) = depth.row_height(i, j);
      quarter.normal(row, column) = {-depth.row_slope_x(i, j) * z, -depth.row_slope_y(i, j) * z, z};
    }
  }
  return quarter;
}

/// One of the four results around a texel.
struct Tap {
  int row = 0;  ///< row and column in the half-resolution buffer
  int column = 0;
  float weight = 0;  ///< bilinear
  bool is_same = false;
};

int wrap_or_clamp(int i, int count, Boundary boundary) {
  return boundary == Boundary::tile ? (i % count + count) % count : std::clamp(i, 0, count - 1);
}

std::array<Tap, 4> find_taps(const DepthBuffer& depth, const Halving& rows, const Halving& columns, int row,
                             int column) {
  const double v = rows.place(row);
  const double u = columns.place(column);
  const int top = static_cast<int>(v);
  const int left = static_cast<int>(u);
  const auto down = static_cast<float>(v - top);
  const auto right = static_cast<float>(u - left);
  const double texel = std::sqrt(depth.spacing.x * depth.spacing.y);
  std::array<Tap, 4> taps;
  for (int k = 0; k < 4; ++k) {
    const int below = k / 2;
    const int beside = k % 2;
    Tap& tap = taps[static_cast<std::size_t>(k)];
    tap.row = wrap_or_clamp(top + below, rows.half, depth.boundary);
    tap.column = wrap_or_clamp(left + beside, columns.half, depth.boundary);
    tap.weight = (below == 1 ? down : 1 - down) * (beside == 1 ? right : 1 - right);
    if (tap.weight <= 0) continue;  // three of the four weights are 0 where the texel itself was kept
    const NeighbourPlace place{.row = rows.source(tap.row),
                               .column = columns.source(tap.column),
                               .x = static_cast<float>((beside - u + left) * 2 * depth.spacing.x),
                               .y = static_cast<float>(-(below - v + top) * 2 * depth.spacing.y)};
    tap.is_same = on_same_surface(depth, row, column, place,
                                  {.distance = static_cast<float>(2 * kGatherTolerance * texel)});
  }
  return taps;
}

float mean_of_taps(const Map& half, const std::array<Tap, 4>& taps) {
  float sum = 0;
  float weights = 0;
  float sum_of_all = 0;
  float all = 0;
  for (const Tap& tap : taps) {
    const float value = half(tap.row, tap.column);
    if (std::isnan(value)) continue;
    sum_of_all += tap.weight * value;
    all += tap.weight;
    if (!tap.is_same) continue;
    sum += tap.weight * value;
    weights += tap.weight;
  }
  if (weights > 0) return sum / weights;
  return all > 0 ? sum_of_all / all : 1.0F;  // in the middle of holes: open
}

}  // namespace

ScreenSpaceView gtao_half_resolution(const DepthBuffer& depth, const GtaoOptions& options) {
  DepthBuffer quarter = make_depth_buffer(pick_quarter(depth));
  quarter.relief = depth.relief;
  GtaoOptions within = options;
  within.bent_normal = false;
  ScreenSpaceView half = gtao(quarter, within);
  const Halving columns(depth.width);
  const Halving rows(depth.height);
  ScreenSpaceView view;
  view.sky_view_factor = view.ambient_occlusion =
      Map(depth.width, depth.height, std::numeric_limits<float>::quiet_NaN());
  view.samples_per_texel = half.samples_per_texel / 4;
  parallel_for(depth.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < depth.width; ++column) {
      if (std::isnan(depth.row_height(row, column))) continue;
      const std::array<Tap, 4> taps = find_taps(depth, rows, columns, row, column);
      view.sky_view_factor(row, column) = mean_of_taps(half.sky_view_factor, taps);
      view.ambient_occlusion(row, column) = mean_of_taps(half.ambient_occlusion, taps);
    }
  });
  return view;
}

}  // namespace heightlight
