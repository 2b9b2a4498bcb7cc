#include <cmath>

#include "base/digits.h"
#include "heightlight/screenspace.h"
#include "screenspace/relaxed_points.h"

// The table of methods. To add one: write its file, declare its function in heightlight/screenspace.h, and
// add a line below (or a loop of lines).

namespace heightlight {
namespace {

using Albedos = std::vector<SurfaceAlbedo>;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Converts the radius from reliefs to world units. A level map has no relief; its radius stays as it is.
template <class Options>
Options in_world_units(Options options, const DepthBuffer& depth) {
  if (std::isfinite(options.radius) && depth.relief > 0) options.radius *= depth.relief;
  return options;
}

std::string slices_in_words(int slices, int steps, double radius, StepDistribution distribution,
                            DepthSampling sampling, DirectionNoise noise) {
  std::string words = in_digits(static_cast<double>(slices)) + " x " + in_digits(static_cast<double>(steps));
  words += std::isinf(radius) ? std::string("; no end") : "; reach " + in_digits(static_cast<double>(radius));
  if (distribution == StepDistribution::uniform) words += "; uniform";
  if (distribution == StepDistribution::stratified) words += "; stratified";
  if (sampling == DepthSampling::mesh) words += "; mesh";
  if (noise == DirectionNoise::spatial) words += "; 16 turns";
  if (noise == DirectionNoise::temporal) words += "; 96 turns";
  return words;
}

std::string in_words(const GtaoOptions& options) {
  std::string words = slices_in_words(options.slices, options.steps, options.radius, options.distribution,
                                      options.sampling, options.noise);
  if (options.falloff > 0) words += "; falloff " + in_digits(static_cast<double>(options.falloff));
  if (options.thickness > 0) words += "; thickness " + in_digits(static_cast<double>(options.thickness));
  if (options.divide_by_open) words += "; divided by open";
  if (options.bent_normal) words += "; bent normal";
  if (options.accumulation > 0) words += "; accumulating " + in_digits(options.accumulation);
  return words;
}

/// A line of the table for GTAO. The radius in `options` is in reliefs.
ScreenSpaceMethod gtao_line(const GtaoOptions& options, bool shown = false) {
  return {.name = "gtao",
          .parameters = in_words(options),
          .shown = shown,
          .run = [options](const DepthBuffer& depth, const Albedos&) {
            return gtao(depth, in_world_units(options, depth));
          }};
}

GtaoOptions gtao_preset(int slices, int steps, double radius, DirectionNoise noise) {
  GtaoOptions options;
  options.slices = slices;
  options.steps = steps;
  options.radius = radius;
  options.noise = noise;
  return options;
}

struct Preset {
  int slices, steps;
};

/// The four usual presets, and the one of Jimenez et al. 2016: a single direction of twelve steps.
constexpr Preset kPresets[] = {{1, 2}, {2, 2}, {3, 3}, {9, 3}, {1, 6}};

/// Radius of the variants below: the best of those tried on four maps.
constexpr double kUsualRadius = 1;

/// Sets the number of directions of three methods of one slice that differ only in their noise: the last
/// method has 96 turns, the one before it none, and one with 16 turns comes earlier.
void number_directions(std::vector<ScreenSpaceMethod>& methods) {
  const std::size_t last = methods.size() - 1;
  methods[last].directions = 96;
  methods[last - 1].directions = 1;
  for (std::size_t i = 0; i < last - 1; ++i) {
    const bool is_same = methods[i].parameters == methods[last - 1].parameters + "; 16 turns";
    if (is_same) methods[i].directions = 16;
  }
}

void add_gtao_presets(std::vector<ScreenSpaceMethod>& methods) {
  for (const Preset& preset : kPresets) {
    for (const double radius : {0.5, 1.0, 2.0, 4.0}) {
      const bool is_usual = radius == kUsualRadius;
      methods.push_back(
          gtao_line(gtao_preset(preset.slices, preset.steps, radius, DirectionNoise::spatial), is_usual));
      if (is_usual && preset.slices == 3) methods.back().role = kRoleOfGames;
    }
    methods.push_back(
        gtao_line(gtao_preset(preset.slices, preset.steps, kUsualRadius, DirectionNoise::none)));
    methods.push_back(
        gtao_line(gtao_preset(preset.slices, preset.steps, kUsualRadius, DirectionNoise::temporal)));
    const bool is_paper = preset.slices == 1 && preset.steps == 6;
    if (is_paper) number_directions(methods);
  }
}

/// Variants of the 3 × 3 preset, each with one thing changed.
void add_gtao_variants(std::vector<ScreenSpaceMethod>& methods) {
  const GtaoOptions preset = gtao_preset(3, 3, kUsualRadius, DirectionNoise::spatial);
  const auto add = [&](auto&& change) {
    GtaoOptions options = preset;
    change(options);
    methods.push_back(gtao_line(options));
  };
  add([](GtaoOptions& o) { o.distribution = StepDistribution::uniform; });
  add([](GtaoOptions& o) { o.distribution = StepDistribution::stratified; });
  add([](GtaoOptions& o) { o.sampling = DepthSampling::mesh; });
  add([](GtaoOptions& o) { o.falloff = 0.5; });
  add([](GtaoOptions& o) { o.divide_by_open = true; });
  add([](GtaoOptions& o) { o.bent_normal = true; });
  add([](GtaoOptions& o) {
    o.noise = DirectionNoise::temporal;
    o.accumulation = 0.1;
  });
  for (const double thickness : {0.01, 0.05, 0.2}) add([=](GtaoOptions& o) { o.thickness = thickness; });
}

/// Jimenez et al. 2016, section 4.3: one direction of twelve steps at half resolution, in 4 × 4 squares and
/// six turns. Then the same without the six turns, and the usual preset at half resolution.
void add_gtao_half_resolution(std::vector<ScreenSpaceMethod>& methods) {
  const auto add = [&](GtaoOptions options) {
    methods.push_back({.name = "gtao",
                       .parameters = in_words(options) + "; half resolution",
                       .run = [options](const DepthBuffer& depth, const Albedos&) {
                         return gtao_half_resolution(depth, in_world_units(options, depth));
                       }});
  };
  GtaoOptions paper = gtao_preset(1, 6, kUsualRadius, DirectionNoise::temporal);
  paper.accumulation = 0.1;
  add(paper);
  add(gtao_preset(1, 6, kUsualRadius, DirectionNoise::spatial));
  add(gtao_preset(3, 3, kUsualRadius, DirectionNoise::spatial));
}

GtaoOptions without_noise(int slices, int steps) {
  GtaoOptions options = gtao_preset(slices, steps, kUnlimited, DirectionNoise::none);
  options.sampling = DepthSampling::mesh;
  options.divide_by_open = true;
  return options;
}

/// Tests how fast slices and steps converge, each with plenty of the other; and what thickness does in the
/// limit.
void add_gtao_sweeps(std::vector<ScreenSpaceMethod>& methods) {
  for (const int slices : {2, 4, 8, 16, 32}) methods.push_back(gtao_line(without_noise(slices, 128)));
  for (const int steps : {8, 16, 32, 64}) methods.push_back(gtao_line(without_noise(32, steps)));
  GtaoOptions converged = without_noise(64, 1024);
  converged.bent_normal = true;
  methods.push_back(gtao_line(converged, true));
  methods.back().role = "GTAO converged";
  GtaoOptions thick = without_noise(32, 64);
  for (const double thickness : {0.001, 0.01}) {
    thick.thickness = thickness;
    methods.push_back(gtao_line(thick, thickness == 0.01));
  }
}

void add_gtao_bounces(std::vector<ScreenSpaceMethod>& methods) {
  const auto add = [&](const GtaoOptions& options, bool shown) {
    methods.push_back({.name = "gtao with bounce",
                       .parameters = in_words(options),
                       .shown = shown,
                       .run = [options](const DepthBuffer& depth, const Albedos&) {
                         return gtao_with_bounce(depth, in_world_units(options, depth));
                       }});
  };
  add(gtao_preset(3, 3, kUsualRadius, DirectionNoise::spatial), true);
  add(gtao_preset(9, 6, kUsualRadius, DirectionNoise::spatial), false);
  add(without_noise(16, 64), true);
}

void add_hbao(std::vector<ScreenSpaceMethod>& methods) {
  const auto add = [&](HbaoOptions options, bool shown) {
    std::string words = slices_in_words(options.slices, options.steps, options.radius, options.distribution,
                                        options.sampling, options.noise);
    if (options.attenuated) words += "; attenuated";
    methods.push_back({.name = "hbao",
                       .parameters = words,
                       .shown = shown,
                       .run = [options](const DepthBuffer& depth, const Albedos&) {
                         return hbao(depth, in_world_units(options, depth));
                       }});
  };
  HbaoOptions options;
  for (const double radius : {0.5, 1.0, 2.0, 4.0}) {
    options.radius = radius;
    add(options, radius == 2);
  }
  options.attenuated = false;
  for (const double radius : {0.5, 1.0, 2.0, 4.0}) {
    options.radius = radius;
    add(options, false);
  }
  options = {64,         128,  StepDistribution::quadratic, DepthSampling::mesh, DirectionNoise::none,
             kUnlimited, false};
  add(options, true);
}

/// A method of containment tests. Its relaxed points are computed beforehand, and it finds totals.
template <class Options>
ScreenSpaceMethod point_line(const char* name, const std::string& words,
                             ScreenSpaceView (*run)(const DepthBuffer&, const Albedos&, const Options&),
                             const Options& options) {
  return {.name = name,
          .parameters = words,
          .finds_totals = true,
          .prepare = [samples = options.samples] { relaxed_points(samples); },
          .run = [run, options](
                     const DepthBuffer& depth,
                     const Albedos& albedos) { return run(depth, albedos, in_world_units(options, depth)); }};
}

std::string measure_in_words(FuzzyMeasure measure) {
  if (measure == FuzzyMeasure::root) return "; root";
  return measure == FuzzyMeasure::exponential ? "; exponential" : "; step";
}

void add_ambient_transfer(std::vector<ScreenSpaceMethod>& methods) {
  const auto add = [&](const AmbientTransferOptions& options, bool shown) {
    std::string words = in_digits(static_cast<double>(options.samples)) + " samples" +
                        "; m = " + in_digits(static_cast<double>(options.tests)) +
                        measure_in_words(options.measure) + "; reach " +
                        in_digits(static_cast<double>(options.radius));
    if (options.noise == DirectionNoise::spatial) words += "; 16 turns";
    methods.push_back(point_line("ambient transfer", words, ambient_transfer, options));
    methods.back().shown = shown;
  };
  for (const FuzzyMeasure measure : {FuzzyMeasure::step, FuzzyMeasure::root, FuzzyMeasure::exponential}) {
    for (const int tests : {1, 2}) {
      for (const double radius : {0.25, 0.5, 1.0, 2.0}) {
        const bool is_shown = radius == 1 && tests == 2 && measure != FuzzyMeasure::exponential;
        add({16, tests, measure, DirectionNoise::spatial, radius}, is_shown);
      }
    }
  }
  add({16, 1, FuzzyMeasure::step, DirectionNoise::none, 1}, false);
  add({64, 2, FuzzyMeasure::step, DirectionNoise::spatial, 1}, false);
  add({256, 32, FuzzyMeasure::step, DirectionNoise::none, 4}, false);
}

void add_ssdo(std::vector<ScreenSpaceMethod>& methods) {
  const auto add = [&](const SsdoOptions& options, bool shown) {
    std::string words = in_digits(static_cast<double>(options.samples)) + " samples" + "; reach " +
                        in_digits(static_cast<double>(options.radius));
    if (options.noise == DirectionNoise::spatial) words += "; 16 turns";
    if (options.smooth_end) words += "; smooth end";
    methods.push_back(point_line("ssdo", words, ssdo, options));
    methods.back().shown = shown;
    methods.back().sky_solid_angle = ssdo_solid_angle(options);
    methods.back().run_under_sky = [options](const DepthBuffer& depth, const SkyGrid& sky) {
      return ssdo_under_sky(depth, sky, in_world_units(options, depth));
    };
  };
  for (const double radius : {0.5, 1.0, 2.0, 4.0}) add({16, DirectionNoise::spatial, radius}, radius == 2);
  add({16, DirectionNoise::none, 2}, false);
  add({64, DirectionNoise::spatial, 2}, false);
  add({8, DirectionNoise::spatial, 2}, false);
  add({.samples = 8, .noise = DirectionNoise::spatial, .radius = 2, .smooth_end = true}, false);
  add({.samples = 64, .noise = DirectionNoise::spatial, .radius = 2, .smooth_end = true}, false);
}

}  // namespace

const std::vector<ScreenSpaceMethod>& screen_space_methods() {
  static const std::vector<ScreenSpaceMethod> kMethods = [] {
    std::vector<ScreenSpaceMethod> methods;
    add_gtao_presets(methods);
    add_gtao_variants(methods);
    add_gtao_half_resolution(methods);
    add_gtao_sweeps(methods);
    add_gtao_bounces(methods);
    add_hbao(methods);
    add_ambient_transfer(methods);
    add_ssdo(methods);
    return methods;
  }();
  return kMethods;
}

}  // namespace heightlight
