#include "models/form_family.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/hash.h"
#include "core/parallel.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

using Eigen::VectorXd;
using Inputs = const ModelInputs&;
using Parameters = const VectorXd&;

const NotesConstants kNotes;
const CubicConstants kCubic;
const SeenConstants kSeen;

FormFamily notes_direct_family() {
  return {"notes_direct",
          "alpha (1 + gain (1 - alpha)^power)",
          "file 004 eq. 7",
          AoKind::ambient_occlusion,
          ExtraInput::none,
          FitTarget::direct,
          {"gain", "power"},
          {kNotes.direct_gain, kNotes.direct_power},
          [](Parameters p, Inputs in, double) {
            return notes_direct(in.ambient_occlusion, NotesConstants{p[0], p[1], 0, 0});
          }};
}

/// F₀ with power 1 does not exceed 1 as long as its gain does not.
FormFamily bounded_direct_family() {
  return {"notes_direct_bounded",
          "alpha (1 + gain (1 - alpha))",
          "file 004 eq. 7 with power 1, at most 1",
          AoKind::ambient_occlusion,
          ExtraInput::none,
          FitTarget::direct,
          {"gain"},
          {kNotes.direct_gain},
          [](Parameters p, Inputs in, double) {
            return notes_direct(in.ambient_occlusion, NotesConstants{p[0], 1, 0, 0});
          }};
}

FormFamily notes_first_bounce_family() {
  return {"notes_first_bounce",
          "A alpha (1 - alpha)^1.5 exp(-B alpha^0.25)",
          "file 004 eq. 11",
          AoKind::ambient_occlusion,
          ExtraInput::none,
          FitTarget::first_bounce,
          {"A", "B"},
          {kNotes.first_gain, kNotes.first_decay},
          [](Parameters p, Inputs in, double) {
            return notes_first_bounce(in.ambient_occlusion, NotesConstants{0, 1, p[0], p[1]});
          }};
}

FormFamily cubic_family(const std::string& name, FitTarget target) {
  return {name,
          "a A^3 - b A^2 + c A; a, b, c linear in albedo",
          "file 000 eq. 33",
          AoKind::sky_view_factor,
          ExtraInput::none,
          target,
          {"a_slope", "a_offset", "b_slope", "b_offset", "c_slope", "c_offset"},
          {kCubic.a_slope, kCubic.a_offset, kCubic.b_slope, kCubic.b_offset, kCubic.c_slope, kCubic.c_offset},
          [](Parameters p, Inputs in, double albedo) {
            // as a polynomial, not held in [0, 1]
            const double sky = in.sky_view_factor.value;
            return (((p[0] * albedo + p[1]) * sky - (p[2] * albedo + p[3])) * sky + p[4] * albedo + p[5]) *
                   sky;
          }};
}

FormFamily seen_from_sky_family() {
  return {"seen_from_sky",
          "G(A, n, rho), n = offset + slope A",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::none,
          FitTarget::total,
          {"offset", "slope"},
          {kSeen.offset, kSeen.slope},
          [](Parameters p, Inputs in, double albedo) {
            SeenConstants constants;
            constants.offset = p[0];
            constants.slope = p[1];
            return bounced_total(in.sky_view_factor, guess_seen(in.sky_view_factor, constants), albedo);
          }};
}

FormFamily seen_from_map_family() {
  return {"seen_from_map",
          "G(A, n, rho), n = offset + s + slope (A - s) + curvature (A - s)^2",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::expected_seen,
          FitTarget::total,
          {"offset", "slope", "curvature"},
          {kSeen.map_offset, kSeen.map_slope, kSeen.map_curvature},
          [](Parameters p, Inputs in, double albedo) {
            SeenConstants constants;
            constants.map_offset = p[0];
            constants.map_slope = p[1];
            constants.map_curvature = p[2];
            return bounced_total(in.sky_view_factor,
                                 guess_seen_on_map(in.sky_view_factor, in.expected_seen, constants), albedo);
          }};
}

SeenConstants deep_constants(Parameters p) {
  SeenConstants constants;
  constants.deep_slope = p[0];
  constants.deep_bend = p[1];
  return constants;
}

FormFamily seen_from_deep_family() {
  return {"seen_from_deep",
          "G(A, n, rho), n = t + (slope + bend t) A",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::deep_seen,
          FitTarget::total,
          {"slope", "bend"},
          {kSeen.deep_slope, kSeen.deep_bend},
          [](Parameters p, Inputs in, double albedo) {
            return bounced_total(in.sky_view_factor,
                                 guess_seen_in_deep(in.sky_view_factor, in.deep_seen, deep_constants(p)),
                                 albedo);
          }};
}

FormFamily seen_from_blur_family() {
  return {"seen_from_blur",
          "G(A, n, rho), n = offset + W + slope (A - W)",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::blurred,
          FitTarget::total,
          {"offset", "slope"},
          {kSeen.blur_offset, kSeen.blur_slope},
          [](Parameters p, Inputs in, double albedo) {
            SeenConstants constants;
            constants.blur_offset = p[0];
            constants.blur_slope = p[1];
            return bounced_total(in.sky_view_factor,
                                 guess_seen_by_blur(in.sky_view_factor, in.blurred, constants), albedo);
          }};
}

/// Sums over a cell's texels.
struct PointSums {
  double weight = 0;
  double sky = 0;
  double extra = 0;
  std::vector<double> measured;
};

double measured_in_bin(const CurveBin& bin, FitTarget target, double albedo) {
  switch (target) {
    case FitTarget::direct:
      return bin.bounces[0].mean;
    case FitTarget::first_bounce:
      return bin.bounces[1].mean;
    case FitTarget::three_bounces:
      return bin_partial_total(bin, albedo, 3);
    case FitTarget::total:
      break;
  }
  return bin_total(bin, albedo);
}

void add_bins(const FormFamily& family, const JudgedMap& map, std::size_t index,
              std::vector<FitPoint>& points) {
  const bool over_alpha = family.kind == AoKind::ambient_occlusion;
  const BounceCurves& curves = over_alpha ? map.over_alpha : map.over_sky;
  double texels = 0;
  for (const CurveBin& bin : curves.filled) texels += static_cast<double>(bin.count);
  for (const CurveBin& bin : curves.filled) {
    FitPoint point;
    point.map = index;
    point.weight = static_cast<double>(bin.count) / texels;
    point.inputs = bin_inputs(map, bin, family.kind);
    point.moments = map.moments;
    for (const double albedo : target_albedos(family.target)) {
      point.measured.push_back(measured_in_bin(bin, family.target, albedo));
    }
    points.push_back(std::move(point));
  }
}

/// Cells over A and its blur, each at the means of its texels.
void add_cells(const FormFamily& family, const JudgedMap& map, std::size_t index,
               std::vector<FitPoint>& points) {
  constexpr int kSide = 24;
  const TexelSample& texels = *map.texels;
  const auto cell_of = [](double share) {
    return std::min(kSide - 1, static_cast<int>(clamp_share(share) * kSide));
  };
  const std::size_t albedos = target_albedos(family.target).size();
  std::map<int, PointSums> cells;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const double sky = double{texels.sky_view_factor[i]};
    const double extra = double{texels.blurred[i]};
    PointSums& cell = cells[cell_of(sky) * kSide + cell_of(extra)];
    cell.weight += 1;
    cell.sky += sky;
    cell.extra += extra;
    cell.measured.resize(albedos);
    for (std::size_t k = 0; k < albedos; ++k) cell.measured[k] += double{texels.totals[k][i]};
  }
  for (auto& [place, cell] : cells) {
    FitPoint point;
    point.map = index;
    point.weight = cell.weight / static_cast<double>(texels.size());
    point.inputs.sky_view_factor = SkyViewFactor(cell.sky / cell.weight);
    point.inputs.blurred = SeenSkyViewFactor(cell.extra / cell.weight);
    for (const double sum : cell.measured) point.measured.push_back(sum / cell.weight);
    points.push_back(std::move(point));
  }
}

/// Materials as numbers, per map.
std::vector<std::size_t> number_materials(const std::vector<JudgedMap>& maps, std::size_t& count) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> of_map;
  for (const JudgedMap& map : maps)
    of_map.push_back(numbers.emplace(map.material, numbers.size()).first->second);
  count = numbers.size();
  return of_map;
}

/// How often each of `count` things comes up when as many are drawn with replacement.
std::vector<double> draw_with_replacement(std::size_t count, std::uint64_t seed) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) {
    times[static_cast<std::size_t>(unit_real(hash_combine(seed, i)) * static_cast<double>(count))] += 1;
  }
  return times;
}

double share_of(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

}  // namespace

const std::vector<FormFamily>& form_families() {
  static const std::vector<FormFamily> families{
      notes_direct_family(),
      bounded_direct_family(),
      notes_first_bounce_family(),
      cubic_family("cubic_three_bounces", FitTarget::three_bounces),
      cubic_family("cubic", FitTarget::total),
      seen_from_sky_family(),
      seen_from_map_family(),
      seen_from_deep_family(),
      seen_from_blur_family(),
  };
  return families;
}

const std::vector<double>& target_albedos(FitTarget target) {
  static const std::vector<double> none{1.0};
  static const std::vector<double> appendix_b{0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9};
  static const std::vector<double> below_one(judged_albedos().begin(), judged_albedos().end() - 1);
  switch (target) {
    case FitTarget::total:
      return below_one;
    case FitTarget::three_bounces:
      return appendix_b;
    default:
      return none;
  }
}

ModelInputs tune_inputs(const FormFamily& family, const VectorXd& parameters, const SeenMoments& moments,
                        ModelInputs inputs) {
  if (family.extra == ExtraInput::deep_seen) {
    inputs.deep_seen = tune_deep_seen(moments, deep_constants(parameters));
  }
  return inputs;
}

std::vector<FitPoint> collect_points(const FormFamily& family, const std::vector<JudgedMap>& maps) {
  std::vector<FitPoint> points;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    if (family.extra == ExtraInput::blurred) {
      if (maps[i].texels) add_cells(family, maps[i], i, points);
    } else if (family.extra == ExtraInput::none ||
               (family.extra == ExtraInput::expected_seen && maps[i].expected_seen) ||
               (family.extra == ExtraInput::deep_seen && maps[i].texels)) {
      add_bins(family, maps[i], i, points);
    }
  }
  return points;
}

LeastSquaresFit fit_family(const FormFamily& family, const std::vector<FitPoint>& points,
                           const std::vector<double>& map_weights) {
  const std::vector<double>& albedos = target_albedos(family.target);
  std::vector<const FitPoint*> used;
  double weight_sum = 0;
  for (const FitPoint& point : points) {
    if (map_weights[point.map] <= 0) continue;
    used.push_back(&point);
    weight_sum += point.weight * map_weights[point.map] * static_cast<double>(albedos.size());
  }
  const auto residuals = [&](const VectorXd& parameters, VectorXd& left) {
    Eigen::Index i = 0;
    for (const FitPoint* point : used) {
      const double root = std::sqrt(point->weight * map_weights[point->map]);
      const ModelInputs inputs = tune_inputs(family, parameters, point->moments, point->inputs);
      for (std::size_t k = 0; k < albedos.size(); ++k) {
        left[i++] = root * (family.evaluate(parameters, inputs, albedos[k]) - point->measured[k]);
      }
    }
  };
  const VectorXd start =
      Eigen::Map<const VectorXd>(family.published.data(), static_cast<Eigen::Index>(family.published.size()));
  const ResidualShape shape{static_cast<Eigen::Index>(used.size()), static_cast<Eigen::Index>(albedos.size()),
                            weight_sum};
  return fit_least_squares(family.name, start, shape, residuals);
}

ParameterIntervals bootstrap_family(const FormFamily& family, const std::vector<FitPoint>& points,
                                    const std::vector<JudgedMap>& maps, const VectorXd& best, int draws,
                                    std::uint64_t seed) {
  constexpr std::size_t kFewestMaterials = 4;
  std::size_t materials = 0;
  const std::vector<std::size_t> material_of = number_materials(maps, materials);
  const bool by_material = materials >= kFewestMaterials;
  FormFamily from_best = family;
  from_best.published.assign(best.data(), best.data() + best.size());
  std::vector<VectorXd> fits(static_cast<std::size_t>(draws));
  parallel_for(draws, [&](std::int64_t draw) {
    const std::uint64_t draw_seed = hash_combine(seed, static_cast<std::uint64_t>(draw));
    std::vector<double> map_weights(maps.size(), 1);
    std::vector<FitPoint> drawn = points;
    if (by_material) {
      const std::vector<double> times = draw_with_replacement(materials, draw_seed);
      for (std::size_t i = 0; i < maps.size(); ++i) map_weights[i] = times[material_of[i]];
    } else {
      const std::vector<double> times = draw_with_replacement(points.size(), draw_seed);
      for (std::size_t i = 0; i < points.size(); ++i) drawn[i].weight *= times[i];
    }
    try {
      fits[static_cast<std::size_t>(draw)] = fit_family(from_best, drawn, map_weights).parameters;
    } catch (const Error&) {
      // counted below
    }
  });
  std::erase_if(fits, [](const VectorXd& fit) { return fit.size() == 0; });
  if (static_cast<int>(fits.size()) * 10 < draws * 9) {
    throw Error("the fit of " + family.name + " does not converge for " +
                std::to_string(draws - static_cast<int>(fits.size())) + " of " + std::to_string(draws) +
                " draws of the bootstrap");
  }
  ParameterIntervals intervals{by_material ? "materials" : "bins", static_cast<int>(fits.size()), best, best};
  for (Eigen::Index p = 0; p < best.size(); ++p) {
    std::vector<double> values;
    for (const VectorXd& fit : fits) values.push_back(fit[p]);
    intervals.low[p] = share_of(values, 0.025);
    intervals.high[p] = share_of(values, 0.975);
  }
  return intervals;
}

}  // namespace heightlight
