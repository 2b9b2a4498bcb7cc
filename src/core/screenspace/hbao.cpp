#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "screenspace/bilateral_gather.h"
#include "screenspace/hbao_kernel.h"

namespace heightlight {

ScreenSpaceView hbao(const DepthBuffer& depth, const HbaoOptions& options) {
  const SliceOptions slices{options.slices,   options.steps, options.distribution,
                            options.sampling, options.noise, options.radius};
  check_slice_options("hbao", slices);
  const int frames = frame_count(options.noise);
  std::vector<SliceTables> tables;
  for (int frame = 0; frame < frames; ++frame) tables.push_back(make_slice_tables(depth, slices, frame));
  const double radius = std::min(options.radius, largest_radius(depth));
  const float per_squared_radius = options.attenuated ? static_cast<float>(1 / (radius * radius)) : 0.0F;
  const float scale = 0.5F / static_cast<float>(options.slices * frames);
  std::vector<Map> open(1, Map(depth.width, depth.height));
  parallel_for(depth.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    std::vector<float> sums(static_cast<std::size_t>(depth.width));
    for (const SliceTables& frame : tables) hbao_row({depth, frame, per_squared_radius}, row, sums);
    for (int column = 0; column < depth.width; ++column) {
      open[0](row, column) = scale * sums[static_cast<std::size_t>(column)];
    }
  });
  if (options.noise != DirectionNoise::none) open = gather_bilaterally(depth, open);
  ScreenSpaceView view;
  view.samples_per_texel = 2.0 * options.slices * options.steps * frames;
  view.ambient_occlusion = std::move(open[0]);
  for (std::size_t i = 0; i < view.ambient_occlusion.size(); ++i) {
    float& value = view.ambient_occlusion.values[i];
    const bool missing = std::isnan(depth.row_height.values[i]);
    value = missing ? std::numeric_limits<float>::quiet_NaN() : std::clamp(value, 0.0F, 1.0F);
  }
  view.sky_view_factor = view.ambient_occlusion;
  return view;
}

}  // namespace heightlight
