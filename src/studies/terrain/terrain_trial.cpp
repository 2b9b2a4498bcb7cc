#include "terrain/terrain_trial.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "base/texels.h"
#include "heightlight/closed_forms.h"
#include "heightlight/solve.h"
#include "heightlight/terrain_forms.h"

namespace heightlight {
namespace {

/// What forms are told of the surface, per texel; 0 where the sample is missing.
struct TerrainFactors {
  TexelVector sky;            ///< A
  TexelVector surface_share;  ///< V
  TexelVector configuration;  ///< C_t
  TexelVector seen_weight;    ///< V/n_z
  TexelVector even;           ///< 1
};

TexelVector present_values(const Surface& surface, const std::function<double(std::size_t)>& value) {
  TexelVector values(surface.map.height.size(), 0.0);
  for_texels(surface.map.height, [&](std::size_t i) {
    if (!std::isnan(surface.map.height.values[i])) values[i] = value(i);
  });
  return values;
}

double mean_over_present(const Surface& surface, const TexelVector& values) {
  double sum = 0;
  double count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(surface.map.height.values[i])) continue;
    sum += values[i];
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

TerrainFactors find_factors(const Surface& surface, const Map& sky_view_factor, const Map& upper_sky) {
  const auto slope_cosine = [&](std::size_t i) { return double{surface.normal.values[i].z}; };
  const auto sky = [&](std::size_t i) { return clamp_share(double{sky_view_factor.values[i]}); };
  return {
      .sky = present_values(surface, sky),
      .surface_share = present_values(surface, [&](std::size_t i) { return 1 - sky(i); }),
      .configuration = present_values(
          surface,
          [&](std::size_t i) { return terrain_configuration(slope_cosine(i), double{upper_sky.values[i]}); }),
      .seen_weight = present_values(surface, [&](std::size_t i) { return (1 - sky(i)) / slope_cosine(i); }),
      .even = present_values(surface, [](std::size_t) { return 1.0; })};
}

/// The means of one window under one light.
struct WindowMaps {
  TexelVector direct, surface_share, configuration, seen_direct, seen_sky;

  WindowMaps(const Surface& surface, const TerrainFactors& factors, const TexelVector& light, double radius)
      : direct(window_mean(surface, light, factors.even, radius)),
        surface_share(window_mean(surface, factors.surface_share, factors.even, radius)),
        configuration(window_mean(surface, factors.configuration, factors.even, radius)),
        seen_direct(window_mean(surface, light, factors.seen_weight, radius)),
        seen_sky(window_mean(surface, factors.sky, factors.seen_weight, radius)) {}

  TerrainMeans at(std::size_t i, double albedo) const {
    return {.albedo = albedo,
            .direct = direct[i],
            .surface_share = surface_share[i],
            .configuration = configuration[i],
            .seen_direct = seen_direct[i],
            .seen_sky = seen_sky[i]};
  }
};

/// All that is tried, and where it is written.
class Trial {
 public:
  Trial(const Surface& surface, const TrialOptions& options, TerrainTrial& results)
      : surface_(surface), options_(options), results_(results) {
    find_truth();
  }

  void try_forms() {
    const double cell = std::sqrt(surface_.map.spacing.x * surface_.map.spacing.y);
    const auto steps = static_cast<std::int64_t>(results_.lights.size() * options_.window_cells.size());
    Progress progress("forms", steps, options_.watch);
    for (const TrialLight& light : results_.lights) {
      bool is_first = true;
      for (const double cells : options_.window_cells) {
        progress.throw_if_stopped();
        const WindowMaps window(surface_, factors_, light.direct, cells * cell);
        for (const TerrainForm& form : terrain_forms()) {
          if ((!form.wants_window && !is_first) || (form.even_sky_only && light.name != "sky")) continue;
          for (std::size_t a = 0; a < options_.albedos.size(); ++a)
            try_form(form, light, a, window, cells * cell);
        }
        is_first = false;
        progress.add(1);
      }
    }
  }

 private:
  /// V_d: A with all that lies below the horizontal dark.
  Map find_upper_sky() const {
    return solve(surface_, {.wanted = {.sky = true, .below = BelowHorizontal::ground},
                            .accuracy = {.error = options_.error, .seed = options_.seed},
                            .checks = {.sky = false},
                            .limits = {.memory = options_.memory},
                            .watch = options_.watch})
        .sky_view_factor;
  }

  void find_truth() {
    Request request;
    request.wanted.sky = true;
    request.wanted.seen = true;
    for (const double albedo : options_.albedos) request.wanted.totals.push_back({.constant = {albedo}});
    request.accuracy = {.error = options_.error, .seed = options_.seed};
    request.limits.memory = options_.memory;
    request.watch = options_.watch;
    Results under_sky = solve(surface_, request);
    const Map& sky = under_sky.sky_view_factor;
    const Map upper = find_upper_sky();
    factors_ = find_factors(surface_, sky, upper);
    results_.mean_sky = mean_over_present(surface_, factors_.sky);
    results_.mean_upper_sky = mean_over_present(
        surface_, present_values(surface_, [&](std::size_t i) { return double{upper.values[i]}; }));
    results_.expected_seen = expected_seen(sky, surface_).value;
    results_.deep_seen = find_deep_seen(under_sky);
    results_.lights.push_back({.name = "sky", .direct = factors_.sky, .totals = {}, .evidence = {}});
    take(std::move(under_sky));

    const Stopwatch stopwatch;
    TexelVector sun = sun_irradiance(surface_, options_.sun, options_.watch);
    results_.sun_cost = stopwatch.elapsed();
    request.wanted.sky = request.wanted.seen = false;
    request.wanted.direct = {sun};
    results_.lights.push_back({.name = "sun",
                               .level = std::sin(options_.sun.elevation_rad),
                               .direct = std::move(sun),
                               .totals = {},
                               .evidence = {}});
    take(solve(surface_, request));
  }

  void take(Results solved) {
    TrialLight& light = results_.lights.back();
    for (std::vector<TexelVector>& total : solved.totals) light.totals.push_back(std::move(total[0]));
    light.mean_direct = mean_over_present(surface_, light.direct);
    light.evidence = std::move(solved.evidence);
  }

  double find_deep_seen(const Results& solved) const {
    SeenMoments moments;
    for (std::size_t i = 0; i < solved.seen.size(); ++i) {
      const double sky = double{solved.sky_view_factor.values[i]};
      if (!std::isnan(sky)) moments.add(SkyViewFactor(sky), SeenSkyViewFactor(double{solved.seen.values[i]}));
    }
    return tune_deep_seen(moments).value;
  }

  TerrainInputs inputs(const TrialLight& light, std::size_t i, double albedo) const {
    return {.direct = light.direct[i],
            .level = light.level,
            .albedo = albedo,
            .sky_view_factor = SkyViewFactor(factors_.sky[i]),
            .configuration = factors_.configuration[i],
            .expected_seen = SeenSkyViewFactor(results_.expected_seen),
            .deep_seen = SeenSkyViewFactor(results_.deep_seen)};
  }

  void try_form(const TerrainForm& form, const TrialLight& light, std::size_t a, const WindowMaps& window,
                double radius) {
    const double albedo = options_.albedos[a];
    const TexelVector& truth = light.totals[a];
    const TexelVector answer = present_values(surface_, [&](std::size_t i) {
      TerrainInputs in = inputs(light, i, albedo);
      in.window = window.at(i, albedo);
      return form.evaluate(in);
    });
    std::vector<double> differences;
    double reflected = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (std::isnan(surface_.map.height.values[i])) continue;
      differences.push_back(answer[i] - truth[i]);
      reflected += truth[i] - light.direct[i];
    }
    if (differences.empty()) return;
    results_.rows.push_back({.light = light.name,
                             .albedo = albedo,
                             .form = form.name,
                             .window = form.wants_window ? radius : 0,
                             .error = measure_differences(differences),
                             .reflected = reflected / static_cast<double>(differences.size())});
  }

  const Surface& surface_;
  const TrialOptions& options_;
  TerrainTrial& results_;
  TerrainFactors factors_;
};

}  // namespace

TerrainTrial try_terrain_forms(const Surface& surface, const TrialOptions& options) {
  check_sun(options.sun);
  TerrainTrial results;
  Trial(surface, options, results).try_forms();
  return results;
}

std::uint64_t trial_bytes_per_texel(std::size_t albedos) {
  constexpr std::uint64_t kVector = sizeof(TexelVector::value_type);
  constexpr std::uint64_t kFactors = 5;
  constexpr std::uint64_t kWindow = 5 + 2;  // and what a mean is made of
  constexpr std::uint64_t kForm = 2;        // an answer and its differences
  return kVector * (kFactors + kWindow + kForm + 2 * (1 + albedos));
}

}  // namespace heightlight
