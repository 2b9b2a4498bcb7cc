#include "shading/specular_study.h"

#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/texel_algebra.h"
#include "gloss/lobe_visibility.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr int kGridSide = 128;

Direction<double> direction_from(const Eigen::Vector3d& d) { return {d.x(), d.y(), d.z()}; }

/// Slopes of every receiver's horizons, at least those of its tangent plane.
struct StoredSlopes {
  std::vector<double> of16, of8;

  const double* at16(std::size_t receiver) const { return of16.data() + receiver * kStoredHorizons; }
  const double* at8(std::size_t receiver) const { return of8.data() + receiver * kStoredHorizons / 2; }
};

StoredSlopes find_slopes(const Surface& surface, const ReceiverGrid& grid) {
  const ExactWalker walker(surface, 4);
  StoredSlopes slopes;
  slopes.of16.resize(grid.texels.size() * kStoredHorizons);
  slopes.of8.resize(slopes.of16.size() / 2);
  parallel_for(static_cast<std::int64_t>(grid.texels.size()), [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    const std::size_t texel = grid.texels[at];
    if (std::isnan(surface.map.height.values[texel])) return;
    const auto width = static_cast<std::size_t>(surface.width());
    const Eigen::Vector3d normal = normal_at(surface, texel);
    for (std::size_t k = 0; k < kStoredHorizons; ++k) {
      const Direction<double> azimuth =
          StoredHorizons<double>(nullptr, kStoredHorizons).azimuth(static_cast<double>(k));
      const Eigen::Vector2d along(azimuth.x, azimuth.y);
      const double tangent = -normal.head<2>().dot(along) / normal.z();
      const double slope = std::max(tangent, walker.horizon_slope(static_cast<int>(texel / width),
                                                                  static_cast<int>(texel % width), along));
      slopes.of16[at * kStoredHorizons + k] = slope;
      if (k % 2 == 0) slopes.of8[(at * kStoredHorizons + k) / 2] = slope;
    }
  });
  return slopes;
}

/// Everything that methods are tried on.
struct SpecularScene {
  const Surface& surface;
  const ReceiverGrid& grid;
  const std::vector<OpennessSource>& sources;
  const StoredSlopes& slopes;
  std::vector<Eigen::Vector3d> views;  ///< unit

  /// A receiver that is seen, with the openness of a source.
  GlossyTexel texel(std::size_t source, std::size_t receiver, const SpecularTruth& truth) const {
    const Openness& open = sources[source].receivers[receiver];
    GlossyTexel made = make_glossy_texel(direction_from(normal_at(surface, grid.texels[receiver])),
                                         direction_from(views[truth.view]), open.sky_view_factor,
                                         direction_from(open.bent_normal));
    made.roughness = truth.roughness;
    made.horizons16 = slopes.at16(receiver);
    made.horizons8 = slopes.at8(receiver);
    return made;
  }
};

/// What each receiver's lobe sees, where the viewer sees the receiver.
SpecularTruth find_truth(const SpecularScene& scene, const RayCaster& caster, double roughness,
                         std::size_t view, const SpecularStudyOptions& options) {
  const std::size_t count = scene.grid.texels.size();
  SpecularTruth truth{.roughness = roughness, .view = view};
  truth.occlusion.assign(count, std::numeric_limits<double>::quiet_NaN());
  std::vector<double> errors(count);
  const LookedLobe lobe{.sampler = ggx_sampler({.roughness = roughness}),
                        .view = scene.views[view],
                        .rays = options.rays,
                        .seed = options.seed};
  Progress progress("specular occlusion", static_cast<std::int64_t>(count), options.watch);
  parallel_for(
      static_cast<std::int64_t>(count),
      [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(i);
        const std::size_t texel = scene.grid.texels[at];
        if (std::isnan(scene.surface.map.height.values[texel])) return;
        const auto width = static_cast<std::size_t>(scene.surface.width());
        const int row = static_cast<int>(texel / width);
        const int column = static_cast<int>(texel % width);
        LobeWorkspace work(options.rays);
        caster.look_along(row, column, {scene.views[view].cast<float>()}, work.rays, work.open);
        if (work.open[0] == 0) return;
        const LobeShare share = look_by_rays(caster, scene.surface, row, column, lobe, work);
        truth.occlusion[at] = share.open;
        errors[at] = share.error;
      },
      &progress);
  double squares = 0;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::isnan(truth.occlusion[i])) continue;
    ++truth.seen;
    if (scene.sources[0].receivers[i].sky_view_factor < kNarrowSky) ++truth.narrow;
    squares += errors[i] * errors[i];
    sum += truth.occlusion[i];
  }
  if (truth.seen == 0) return truth;
  truth.rmse = std::sqrt(squares / static_cast<double>(truth.seen));
  truth.mean = sum / static_cast<double>(truth.seen);
  return truth;
}

/// Errors of a method on one truth; NaN where the receiver is not seen.
std::vector<double> find_errors(const SpecularScene& scene, std::size_t source, const SpecularMethod& method,
                                const SpecularTruth& truth) {
  std::vector<double> errors(truth.occlusion.size(), std::numeric_limits<double>::quiet_NaN());
  parallel_for(static_cast<std::int64_t>(errors.size()), [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    if (std::isnan(truth.occlusion[at])) return;
    errors[at] = method.occlusion(scene.texel(source, at, truth)) - truth.occlusion[at];
  });
  return errors;
}

SpecularRow measure_method(const SpecularScene& scene, const std::vector<double>& errors,
                           const SpecularTruth& truth) {
  SpecularRow row{.roughness = truth.roughness, .view = truth.view};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (std::isnan(errors[i])) continue;
    row.rmse += errors[i] * errors[i];
    row.bias += errors[i];
    if (scene.sources[0].receivers[i].sky_view_factor < kNarrowSky) row.narrow_rmse += errors[i] * errors[i];
  }
  const auto seen = static_cast<double>(std::max<std::size_t>(1, truth.seen));
  row.rmse = std::sqrt(row.rmse / seen);
  row.bias /= seen;
  row.narrow_rmse = std::sqrt(row.narrow_rmse / static_cast<double>(std::max<std::size_t>(1, truth.narrow)));
  return row;
}

/// u with the least sum of squares over all truths, by golden section in its logarithm.
double fit_cone_share(const SpecularScene& scene, const std::vector<SpecularTruth>& truths) {
  const auto squares_at = [&](double logarithm) {
    const LobeConeConstants constants{std::exp(logarithm)};
    double squares = 0;
    for (const SpecularTruth& truth : truths) {
      for (std::size_t i = 0; i < truth.occlusion.size(); ++i) {
        if (std::isnan(truth.occlusion[i])) continue;
        const GlossyTexel texel = scene.texel(0, i, truth);
        const double error = cone_cone_occlusion(SkyViewFactor{texel.sky_view_factor}, texel.apart,
                                                 texel.roughness, constants) -
                             truth.occlusion[i];
        squares += error * error;
      }
    }
    return squares;
  };
  constexpr double kGolden = 0.6180339887498949;
  double low = std::log(1e-12);
  double high = std::log(0.9);
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  double at_left = squares_at(left);
  double at_right = squares_at(right);
  for (int step = 0; step < 18; ++step) {
    if (at_left < at_right) {
      high = right;
      right = left;
      at_right = at_left;
      left = high - kGolden * (high - low);
      at_left = squares_at(left);
    } else {
      low = left;
      left = right;
      at_left = at_right;
      right = low + kGolden * (high - low);
      at_right = squares_at(right);
    }
  }
  return std::exp(0.5 * (low + high));
}

SpecularPicture make_picture(const ReceiverGrid& grid, const SpecularTruth& truth,
                             const std::vector<double>& values) {
  SpecularPicture picture{.roughness = truth.roughness};
  picture.occlusion = Map(grid.columns, grid.rows);
  for (std::size_t i = 0; i < values.size(); ++i) picture.occlusion.values[i] = static_cast<float>(values[i]);
  return picture;
}

/// Over the receivers of a truth in the middle, on one processor.
double time_method(const SpecularScene& scene, const SpecularMethod& method, const SpecularTruth& truth) {
  std::vector<GlossyTexel> texels;
  for (std::size_t i = 0; i < truth.occlusion.size() && texels.size() < 4096; ++i) {
    if (!std::isnan(truth.occlusion[i])) texels.push_back(scene.texel(0, i, truth));
  }
  if (texels.empty()) return 0;
  double sum = 0;
  const Cost cost = least_cost([&] {
    for (const GlossyTexel& texel : texels) sum += method.occlusion(texel);
  });
  return sum < 0 ? 0 : 1e9 * cost.wall / static_cast<double>(texels.size());
}

void try_methods(const SpecularScene& scene, const std::vector<SpecularMethod>& methods,
                 SpecularStudy& study) {
  for (const SpecularTruth& truth : study.truths) {
    for (const SpecularMethod& method : methods) {
      for (std::size_t s = 0; s < (method.takes_openness ? scene.sources.size() : 1); ++s) {
        SpecularRow row = measure_method(scene, find_errors(scene, s, method, truth), truth);
        row.input = method.takes_openness ? scene.sources[s].name : "";
        row.method = method.name;
        study.rows.push_back(row);
      }
    }
  }
  for (const SpecularMethod& method : methods)
    study.times.push_back({method.name, time_method(scene, method, study.truths[study.truths.size() / 2])});
}

/// The methods that are shown, on a window.
std::vector<SpecularPicture> draw_methods(const SpecularScene& scene, const RayCaster& caster,
                                          const std::vector<SpecularMethod>& methods,
                                          const SpecularStudyOptions& options) {
  std::vector<SpecularPicture> pictures;
  for (const double roughness : options.roughness) {
    const SpecularTruth truth = find_truth(scene, caster, roughness, scene.views.size() / 2, options);
    pictures.push_back(make_picture(scene.grid, truth, truth.occlusion));
    for (const SpecularMethod& method : methods) {
      if (!method.shown) continue;
      std::vector<double> values = find_errors(scene, 0, method, truth);
      const double rmse = measure_method(scene, values, truth).rmse;
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += truth.occlusion[i];
      pictures.push_back(make_picture(scene.grid, truth, values));
      pictures.back().method = method.name;
      pictures.back().rmse = rmse;
    }
  }
  return pictures;
}

}  // namespace

SpecularStudy study_specular(const Surface& surface, const SpecularStudyOptions& options) {
  for (const double roughness : options.roughness) check_gloss({.roughness = roughness});
  for (const Vector3& view : options.views) check_view(view);
  SpecularStudy study;
  study.grid = pick_receiver_grid(surface, kGridSide, options.seed);
  const std::vector<OpennessSource> sources =
      find_openness(surface, study.grid, options.memory, options.watch);
  const StoredSlopes slopes = find_slopes(surface, study.grid);
  SpecularScene scene{
      .surface = surface, .grid = study.grid, .sources = sources, .slopes = slopes, .views = {}};
  for (const Vector3& view : options.views) scene.views.push_back(as_eigen(view).cast<double>().normalized());
  const RayCaster caster(surface, {.rays = options.rays});
  for (std::size_t view = 0; view < options.views.size(); ++view) {
    for (const double roughness : options.roughness) {
      study.truths.push_back(find_truth(scene, caster, roughness, view, options));
      if (study.truths.back().seen == 0) throw Error("nothing of the surface is seen from a view");
    }
  }
  study.fitted_share = fit_cone_share(scene, study.truths);
  const std::vector<SpecularMethod> methods = specular_methods(options.tables, study.fitted_share);
  try_methods(scene, methods, study);
  const ReceiverGrid window = pick_receiver_window(surface, kGridSide);
  const std::vector<OpennessSource> exact{find_exact_openness(surface, window, options.watch)};
  const StoredSlopes window_slopes = find_slopes(surface, window);
  study.pictures =
      draw_methods({surface, window, exact, window_slopes, scene.views}, caster, methods, options);
  return study;
}

}  // namespace heightlight
