#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "screenspace/bilateral_gather.h"
#include "screenspace/gtao_kernel.h"

namespace heightlight {
namespace {

SliceOptions slice_options(const GtaoOptions& options) {
  return {options.slices,   options.steps, options.distribution,
          options.sampling, options.noise, options.radius};
}

void check_options(const GtaoOptions& options) {
  check_slice_options("gtao", slice_options(options));
  if (!(options.falloff >= 0 && options.falloff <= 1))
    throw UsageError("gtao: the falloff must be in [0, 1]");
  if (!(options.accumulation >= 0 && options.accumulation <= 1))
    throw UsageError("gtao: the accumulation must be in [0, 1]");
  if (!(options.thickness >= 0)) throw UsageError("gtao: the thickness must not be negative");
}

GtaoPass make_pass(const DepthBuffer& depth, const SliceTables& tables, const GtaoOptions& options) {
  GtaoPass pass{depth, tables};
  pass.attenuated = options.falloff > 0 || options.thickness > 0;
  pass.thickness = static_cast<float>(options.thickness);
  if (options.falloff > 0) {
    const double radius = std::min(options.radius, largest_radius(depth));
    pass.radius = static_cast<float>(radius);
    pass.per_falloff = static_cast<float>(1 / (options.falloff * radius));
  }
  return pass;
}

/// Weight of a frame. In an accumulation buffer the newest frame has the weight a, and each frame before it 1
/// − a times the weight of the next. Frames that are six turns apart have the same directions, and share one
/// weight.
float frame_weight(const GtaoOptions& options, int frame, int frames) {
  if (options.accumulation <= 0) return 1 / static_cast<float>(frames);
  const double kept = 1 - options.accumulation;
  const double age = frames - 1 - frame;
  return static_cast<float>(options.accumulation * std::pow(kept, age) / (1 - std::pow(kept, frames)));
}

GtaoSums make_line(int columns, const GtaoOptions& options) {
  const auto width = static_cast<std::size_t>(columns);
  GtaoSums line;
  line.sky.resize(width);
  line.solid.resize(width);
  if (options.divide_by_open) line.open.resize(width);
  if (options.bent_normal) {
    for (std::vector<float>& part : line.bent) part.resize(width);
  }
  return line;
}

/// Sums over all frames, divided by what they are in the open: A, α, then the others that were asked for.
std::vector<Map> trace(const DepthBuffer& depth, const GtaoOptions& options) {
  const std::size_t results = 2 + (options.divide_by_open ? 1 : 0) + (options.bent_normal ? 3 : 0);
  std::vector<Map> sums(results, Map(depth.width, depth.height));
  const int frames = frame_count(options.noise);
  std::vector<SliceTables> tables;
  for (int frame = 0; frame < frames; ++frame) {
    tables.push_back(make_slice_tables(depth, slice_options(options), frame));
  }
  parallel_for(depth.height, [&](std::int64_t i) {
    const int row = static_cast<int>(i);
    for (int frame = 0; frame < frames; ++frame) {
      GtaoSums line = make_line(depth.width, options);
      gtao_row(make_pass(depth, tables[static_cast<std::size_t>(frame)], options), row, line);
      const float scale = 0.5F / static_cast<float>(options.slices) * frame_weight(options, frame, frames);
      std::size_t result = 0;
      for (const std::vector<float>* from :
           {&line.sky, &line.solid, &line.open, &line.bent[0], &line.bent[1], &line.bent[2]}) {
        if (from->empty()) continue;
        for (int column = 0; column < depth.width; ++column)
          sums[result](row, column) += scale * (*from)[static_cast<std::size_t>(column)];
        ++result;
      }
    }
  });
  return sums;
}

}  // namespace

ScreenSpaceView gtao(const DepthBuffer& depth, const GtaoOptions& options) {
  check_options(options);
  std::vector<Map> results = trace(depth, options);
  if (options.noise != DirectionNoise::none) results = gather_bilaterally(depth, results);
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  ScreenSpaceView view;
  view.samples_per_texel = 2.0 * options.slices * options.steps * frame_count(options.noise);
  view.sky_view_factor = std::move(results[0]);
  view.ambient_occlusion = std::move(results[1]);
  for (std::size_t i = 0; i < view.sky_view_factor.size(); ++i) {
    const bool missing = std::isnan(depth.row_height.values[i]);
    float& sky = view.sky_view_factor.values[i];
    if (options.divide_by_open) sky /= results[2].values[i];
    for (float* share : {&sky, &view.ambient_occlusion.values[i]})
      *share = missing ? kMissing : std::clamp(*share, 0.0F, 1.0F);
  }
  if (!options.bent_normal) return view;
  const Map* bent = results.data() + results.size() - 3;
  view.bent_normal = Image<Vector3>(depth.width, depth.height);
  for (std::size_t i = 0; i < view.bent_normal.size(); ++i) {
    const Eigen::Vector3f sum(bent[0].values[i], bent[1].values[i], bent[2].values[i]);
    view.bent_normal.values[i] = std::isnan(depth.row_height.values[i])
                                     ? Vector3{kMissing, kMissing, kMissing}
                                     : to_vector3(Eigen::Vector3f(sum.normalized()));
  }
  return view;
}

}  // namespace heightlight
