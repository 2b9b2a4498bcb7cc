#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "screenspace/bilateral_gather.h"
#include "screenspace/gtao_bounce_kernel.h"

namespace heightlight {
namespace {

/// Copies a map to the layout of the depth buffer's heights; 0 where there is no sample.
std::vector<float> lay_out(const DepthBuffer& depth, const Map& map) {
  std::vector<float> values(depth.heights.size(), 0.0F);
  parallel_for(depth.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int column = 0; column < depth.stride * DepthBuffer::kPhases; ++column) {
      const int source = column % depth.period_columns;
      const float value = source < depth.width ? map(row, source) : 0.0F;
      values[depth.index(row, column)] = std::isnan(value) ? 0.0F : value;
    }
  });
  return values;
}

}  // namespace

ScreenSpaceView gtao_with_bounce(const DepthBuffer& depth, const GtaoOptions& options) {
  GtaoOptions plain = options;
  plain.bent_normal = false;
  plain.falloff = plain.thickness = 0;
  ScreenSpaceView view = gtao(depth, plain);
  const std::vector<float> radiance = lay_out(depth, view.sky_view_factor);
  const SliceOptions slices{options.slices,   options.steps, options.distribution,
                            options.sampling, options.noise, options.radius};
  std::vector<SliceTables> tables;
  for (int frame = 0; frame < frame_count(options.noise); ++frame) {
    tables.push_back(make_slice_tables(depth, slices, frame));
  }
  std::vector<Map> sums(2, Map(depth.width, depth.height));
  parallel_for(depth.height, [&](std::int64_t row) {
    const std::vector<float> none(static_cast<std::size_t>(depth.width));
    SeenSums line{none, none};
    for (const SliceTables& frame : tables)
      gather_slices({depth, frame, radiance}, static_cast<int>(row), line);
    const auto first = static_cast<std::ptrdiff_t>(row * depth.width);
    std::copy(line.hidden.begin(), line.hidden.end(), sums[0].values.begin() + first);
    std::copy(line.light.begin(), line.light.end(), sums[1].values.begin() + first);
  });
  if (options.noise != DirectionNoise::none) sums = gather_bilaterally(depth, sums);
  view.samples_per_texel *= 2;
  view.seen = Map(depth.width, depth.height);
  for (std::size_t i = 0; i < view.seen.size(); ++i) {
    const float hidden = sums[0].values[i];
    const float mean = hidden > 0 ? std::clamp(sums[1].values[i] / hidden, 0.0F, 1.0F) : 1.0F;
    view.seen.values[i] =
        std::isnan(depth.row_height.values[i]) ? std::numeric_limits<float>::quiet_NaN() : mean;
  }
  return view;
}

}  // namespace heightlight
