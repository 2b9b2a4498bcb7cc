#include "shading/directional_study.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "shading/counted.h"
#include "skylight/sky_slices.h"
#include "visibility/exact_walk.h"

namespace heightlight {
namespace {

constexpr int kShadedSide = 128;
constexpr int kProbeRows = 64;  // of the prefiltered sky
constexpr int kFormSteps = 45;  // of figure 10: 2°

/// E/π per receiver, red, green and blue; NaN where the sample is missing.
using Shaded = std::vector<Eigen::Vector3d>;

/// A sky as shaders have it.
struct ShaderSky {
  const NamedSky& sky;
  SkyLight probe;  ///< prefiltered
  std::array<Harmonics, 3> harmonics;
};

/// All that a way to shade is told of a receiver.
struct ShadedReceiver {
  DiffuseTexel<double> texel;
  const Harmonics* own = nullptr;  ///< of its `sh` map; null where there is none
  double spread_cosine = 1;        ///< of the cone of the spread; NaN where that is not known
};

/// A way to shade one receiver under one sky.
struct ShadingMethod {
  std::string name = {};
  bool by_probe = false;
  bool is_baked = false;  ///< from maps that GTAO does not make
  std::function<Eigen::Vector3d(const ShaderSky& sky, const ShadedReceiver& receiver)> shade = {};
};

template <class Shade>
ShadingMethod harmonic_method(const char* name, Shade shade) {
  return {.name = name, .shade = [shade](const ShaderSky& sky, const ShadedReceiver& receiver) {
            return Eigen::Vector3d(shade(sky.harmonics[0], receiver.texel),
                                   shade(sky.harmonics[1], receiver.texel),
                                   shade(sky.harmonics[2], receiver.texel));
          }};
}

Vector3 to_floats(const Direction<double>& d) {
  return {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
}

Eigen::Vector3d probe_light(const ShaderSky& sky, const ShadedReceiver& receiver,
                            const Direction<double>& along) {
  const Vector3 light = look_up(sky.probe, to_floats(along));
  return clamp_share(receiver.texel.sky.value) * as_eigen(light).cast<double>();
}

std::vector<ShadingMethod> shading_methods() {
  using Texel = DiffuseTexel<double>;
  return {
      {.name = kAoProbe,
       .by_probe = true,
       .shade =
           [](const ShaderSky& sky, const ShadedReceiver& receiver) {
             return probe_light(sky, receiver, receiver.texel.normal);
           }},
      {.name = kBentProbe,
       .by_probe = true,
       .shade =
           [](const ShaderSky& sky, const ShadedReceiver& receiver) {
             return probe_light(sky, receiver, receiver.texel.bent_normal);
           }},
      harmonic_method(kAoHarmonics,
                      [](const Harmonics& sky, const Texel& texel) { return shade_by_normal(sky, texel); }),
      harmonic_method(kBentHarmonics, [](const Harmonics& sky,
                                         const Texel& texel) { return shade_by_bent_normal(sky, texel); }),
      harmonic_method(kTripleProduct, [](const Harmonics& sky,
                                         const Texel& texel) { return shade_by_triple_product(sky, texel); }),
      harmonic_method(kDirectionalGtao,
                      [](const Harmonics& sky, const Texel& texel) { return shade_by_cone(sky, texel); }),
      {.name = kSpreadCone,
       .is_baked = true,
       .shade =
           [](const ShaderSky& sky, const ShadedReceiver& receiver) {
             const auto shade = [&](std::size_t channel) {
               return shade_by_given_cone(sky.harmonics.at(channel), receiver.texel, receiver.spread_cosine);
             };
             return Eigen::Vector3d(shade(0), shade(1), shade(2));
           }},
      {.name = kOwnHarmonics,
       .is_baked = true,
       .shade = [](const ShaderSky& sky, const ShadedReceiver& receiver) {
         return Eigen::Vector3d(dot(*receiver.own, sky.harmonics[0]), dot(*receiver.own, sky.harmonics[1]),
                                dot(*receiver.own, sky.harmonics[2]));
       }}};
}

Direction<double> to_direction(const Eigen::Vector3d& d) { return {d.x(), d.y(), d.z()}; }

ShadedReceiver receiver_of(const Surface& surface, const ReceiverGrid& grid, const OpennessSource& source,
                           std::size_t receiver) {
  const Openness& open = source.receivers[receiver];
  return {.texel = {.normal = to_direction(normal_at(surface, grid.texels[receiver])),
                    .bent_normal = to_direction(open.bent_normal),
                    .sky = SkyViewFactor<double>(open.sky_view_factor)},
          .own = source.harmonics.empty() ? nullptr : &source.harmonics[receiver],
          .spread_cosine = std::cos(open.spread_half_angle)};
}

bool is_missing(const Surface& surface, std::size_t texel) {
  return std::isnan(surface.map.height.values[texel]);
}

Eigen::Vector3d nothing_known() {
  return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

/// Per sky, over the same horizons.
std::vector<Shaded> find_true_light(const Surface& surface, const ReceiverGrid& grid,
                                    const DirectionalStudyOptions& options) {
  const ExactWalker walker(surface, kOpennessAzimuths);
  std::vector<SkySlices> slices;
  for (const NamedSky& sky : options.skies) slices.emplace_back(sky.light, kOpennessAzimuths);
  std::vector<Shaded> light(options.skies.size(), Shaded(grid.texels.size(), nothing_known()));
  Progress progress("light of skies", static_cast<std::int64_t>(grid.texels.size()), options.watch);
  parallel_for(
      static_cast<std::int64_t>(grid.texels.size()),
      [&](std::int64_t i) {
        const auto at = static_cast<std::size_t>(i);
        const std::size_t texel = grid.texels[at];
        if (is_missing(surface, texel)) return;
        const auto width = static_cast<std::size_t>(surface.width());
        std::vector<double> horizons;
        for (int k = 0; k < walker.azimuths(); ++k)
          horizons.push_back(walker.horizon_rad(static_cast<int>(texel / width),
                                                static_cast<int>(texel % width), walker.azimuth_rad(k)));
        for (std::size_t s = 0; s < slices.size(); ++s)
          light[s][at] = slices[s].irradiance(normal_at(surface, texel), horizons);
      },
      &progress);
  return light;
}

/// Of the sky as nine harmonics have it: exact moments of what is seen, times its coefficients.
Shaded find_harmonic_light(const ShaderSky& sky, const OpennessSource& exact) {
  Shaded light;
  for (const Harmonics& own : exact.harmonics)
    light.emplace_back(dot(own, sky.harmonics[0]), dot(own, sky.harmonics[1]), dot(own, sky.harmonics[2]));
  return light;
}

/// All 0 where no sample is present.
DirectionalRow measure_shading(const Shaded& found, const Shaded& truth) {
  DirectionalRow row;
  double count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (truth[i].hasNaN()) continue;
    const Eigen::Array3d error = found[i].array() - truth[i].array();
    row.mrse += (error / truth[i].array().max(kLeastLight)).square().mean();
    row.rmse += error.square().mean();
    row.bias += error.mean();
    ++count;
  }
  count = std::max(count, 1.0);
  row.mrse /= count;
  row.rmse = std::sqrt(row.rmse / count);
  row.bias /= count;
  return row;
}

ShadedPicture make_picture(const ReceiverGrid& grid, const Shaded& light) {
  ShadedPicture picture;
  picture.light = Image<Vector3>(grid.columns, grid.rows);
  for (std::size_t i = 0; i < light.size(); ++i) picture.light.values[i] = to_vector3(light[i].cast<float>());
  return picture;
}

Shaded shade_all(const Surface& surface, const ReceiverGrid& grid, const OpennessSource& source,
                 const ShaderSky& sky, const ShadingMethod& method) {
  Shaded found(grid.texels.size(), nothing_known());
  parallel_for(static_cast<std::int64_t>(found.size()), [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    if (!is_missing(surface, grid.texels[at]))
      found[at] = method.shade(sky, receiver_of(surface, grid, source, at));
  });
  return found;
}

/// What a picture is drawn of.
struct DrawnWindow {
  const Shaded& truth;
  const OpennessSource& exact;
};

/// The truth, and every way to shade, on a window under a sky.
void draw_shading(const Surface& surface, const ReceiverGrid& window, const DrawnWindow& drawn,
                  const ShaderSky& sky, std::vector<ShadedPicture>& pictures) {
  pictures.push_back(make_picture(window, drawn.truth));
  pictures.back().sky = sky.sky.name;
  for (const ShadingMethod& method : shading_methods()) {
    const Shaded found = shade_all(surface, window, drawn.exact, sky, method);
    pictures.push_back(make_picture(window, found));
    pictures.back().sky = sky.sky.name;
    pictures.back().method = method.name;
    pictures.back().mrse = measure_shading(found, drawn.truth).mrse;
  }
}

/// Over the first receivers under one sky, on one processor.
double time_shading(const ShadingMethod& method, const ShaderSky& sky,
                    const std::vector<ShadedReceiver>& receivers) {
  double sum = 0;
  const Cost cost = least_cost([&] {
    for (const ShadedReceiver& receiver : receivers) sum += method.shade(sky, receiver).sum();
  });
  constexpr int kChannels = 3;
  return std::isnan(sum) ? 0 : 1e9 * cost.wall / static_cast<double>(receivers.size()) / kChannels;
}

/// What one channel of the harmonic ways takes, by running them on numbers that count.
OperationCount count_shading(const std::string& method) {
  NineHarmonics<Counted> sky{};
  const DiffuseTexel<Counted> texel{{Counted(0), Counted(0), Counted(1)},
                                    {Counted(0), Counted(0), Counted(1)},
                                    SkyViewFactor<Counted>(Counted(0.5))};
  product_terms();
  return count_operations([&] {
    if (method == kAoHarmonics) shade_by_normal(sky, texel);
    if (method == kBentHarmonics) shade_by_bent_normal(sky, texel);
    if (method == kTripleProduct) shade_by_triple_product(sky, texel);
    if (method == kDirectionalGtao) shade_by_cone(sky, texel);
    if (method == kSpreadCone) shade_by_given_cone(sky, texel, Counted(0.5));
    if (method == kOwnHarmonics) dot(sky, sky);
  });
}

std::vector<ShadingCost> find_costs(const Surface& surface, const ReceiverGrid& grid,
                                    const OpennessSource& exact, const ShaderSky& sky) {
  std::vector<ShadedReceiver> receivers;
  for (std::size_t i = 0; i < grid.texels.size() && receivers.size() < 4096; ++i) {
    if (!is_missing(surface, grid.texels[i])) receivers.push_back(receiver_of(surface, grid, exact, i));
  }
  std::vector<ShadingCost> costs;
  for (const ShadingMethod& method : shading_methods()) {
    const OperationCount operations = count_shading(method.name);
    costs.push_back({.method = method.name,
                     .nanoseconds = time_shading(method, sky, receivers),
                     .arithmetic = operations.arithmetic,
                     .functions = operations.functions,
                     .lookups = method.by_probe ? 1 : 0});
  }
  return costs;
}

}  // namespace

DirectionalStudy study_directional(const Surface& surface, const DirectionalStudyOptions& options) {
  for (const NamedSky& sky : options.skies) check_sky_light(sky.light);
  DirectionalStudy study;
  study.grid = pick_receiver_grid(surface, kShadedSide, options.seed);
  if (std::all_of(study.grid.texels.begin(), study.grid.texels.end(),
                  [&](std::size_t texel) { return is_missing(surface, texel); }))
    throw Error("no sample is present where the study looks");
  const std::vector<Shaded> truths = find_true_light(surface, study.grid, options);
  const std::vector<OpennessSource> sources =
      find_openness(surface, study.grid, options.memory, options.watch);
  const ReceiverGrid window = pick_receiver_window(surface, kShadedSide);
  const std::vector<Shaded> window_truths = find_true_light(surface, window, options);
  const OpennessSource exact = find_exact_openness(surface, window, options.watch);
  for (std::size_t s = 0; s < options.skies.size(); ++s) {
    const NamedSky& named = options.skies[s];
    const ShaderSky sky{named, open_irradiance(named.light, kProbeRows), project_sky(named.light)};
    const Shaded harmonic_truth = find_harmonic_light(sky, sources.front());
    for (const ShadingMethod& method : shading_methods()) {
      for (const OpennessSource& source : sources) {
        if (method.is_baked && source.harmonics.empty()) continue;
        const Shaded found = shade_all(surface, study.grid, source, sky, method);
        for (const bool as_harmonics : {false, true}) {
          if (as_harmonics && method.by_probe) continue;  // in nine harmonics it is the way by harmonics
          DirectionalRow row = measure_shading(found, as_harmonics ? harmonic_truth : truths[s]);
          row.sky = named.name;
          row.as_harmonics = as_harmonics;
          row.input = source.name;
          row.method = method.name;
          study.rows.push_back(row);
        }
      }
    }
    draw_shading(surface, window, {window_truths[s], exact}, sky, study.pictures);
    if (s == 0) study.costs = find_costs(surface, study.grid, sources.front(), sky);
  }
  study.forms = judge_cone_forms(kFormSteps);
  return study;
}

}  // namespace heightlight
