#include "fit/fit_points.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "base/digits.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

using Eigen::VectorXd;

/// Sums over a cell's texels.
struct PointSums {
  double weight = 0;
  double alpha = 0;
  double sky = 0;
  double blurred = 0;
  double seen = 0;
  std::vector<double> measured;
};

double measured_in_bin(const CurveBin& bin, const FormFamily& family, double albedo) {
  switch (family.target) {
    case FitTarget::one_bounce:
      return bin.bounces[family.bounce].mean;
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
    point.albedos = target_albedos(family.target);
    for (const double albedo : point.albedos) {
      point.measured.push_back(measured_in_bin(bin, family, albedo));
    }
    points.push_back(std::move(point));
  }
}

/// The inputs that vary over a map, of which the family is a function.
std::vector<const std::vector<float>*> varying_inputs(const FormFamily& family, const TexelSample& texels) {
  const bool over_alpha = family.kind == AoKind::ambient_occlusion;
  std::vector<const std::vector<float>*> inputs;
  if (over_alpha || family.both_kinds) inputs.push_back(&texels.ambient_occlusion);
  if (!over_alpha || family.both_kinds) inputs.push_back(&texels.sky_view_factor);
  if (family.extra == ExtraInput::blurred) inputs.push_back(&texels.blurred);
  if (family.extra == ExtraInput::seen) inputs.push_back(&texels.seen);
  return inputs;
}

/// Cells over those inputs, each at the means of its texels.
void add_cells(const FormFamily& family, const JudgedMap& map, std::size_t index,
               std::vector<FitPoint>& points) {
  constexpr int kSide = 24;
  const TexelSample& texels = *map.texels;
  const std::vector<const std::vector<float>*> inputs = varying_inputs(family, texels);
  const std::size_t albedos = target_albedos(family.target).size();
  std::map<int, PointSums> cells;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    int place = 0;
    for (const std::vector<float>* input : inputs)
      place = place * kSide + std::min(kSide - 1, static_cast<int>(clamp_share((*input)[i]) * kSide));
    PointSums& cell = cells[place];
    cell.weight += 1;
    cell.alpha += double{texels.ambient_occlusion[i]};
    cell.sky += double{texels.sky_view_factor[i]};
    cell.blurred += double{texels.blurred[i]};
    cell.seen += double{texels.seen[i]};
    cell.measured.resize(albedos);
    for (std::size_t k = 0; k < albedos; ++k) cell.measured[k] += double{texels.totals[k][i]};
  }
  for (auto& [place, cell] : cells) {
    FitPoint point;
    point.map = index;
    point.weight = cell.weight / static_cast<double>(texels.size());
    point.inputs.ambient_occlusion = AmbientOcclusion(cell.alpha / cell.weight);
    point.inputs.sky_view_factor = SkyViewFactor(cell.sky / cell.weight);
    point.inputs.blurred = SeenSkyViewFactor(cell.blurred / cell.weight);
    point.inputs.seen = SeenSkyViewFactor(cell.seen / cell.weight);
    point.albedos = target_albedos(family.target);
    for (const double sum : cell.measured) point.measured.push_back(sum / cell.weight);
    points.push_back(std::move(point));
  }
}

/// Where a form has a pole, as a user would look for it.
std::string describe_point(const FormFamily& family, const FitPoint& point, double albedo) {
  const bool over_alpha = family.kind == AoKind::ambient_occlusion;
  std::string text = over_alpha ? "alpha = " + in_digits(point.inputs.ambient_occlusion.value, 4)
                                : "A = " + in_digits(point.inputs.sky_view_factor.value, 4);
  if (family.extra == ExtraInput::seen) text += ", n = " + in_digits(point.inputs.seen.value, 4);
  return text + ", rho = " + in_digits(albedo);
}

/// Why a family cannot be fitted from there; empty where nothing is in the way.
std::string find_pole(const FormFamily& family, const std::vector<const FitPoint*>& points,
                      const VectorXd& parameters) {
  for (const FitPoint* point : points) {
    for (const double albedo : point->albedos) {
      if (std::isfinite(family.evaluate(parameters, point->inputs, albedo))) continue;
      return "is not finite at " + describe_point(family, *point, albedo);
    }
  }
  return "";
}

VectorXd to_parameters(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace

std::vector<FitPoint> collect_points(const FormFamily& family, const std::vector<JudgedMap>& maps) {
  std::vector<FitPoint> points;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const bool by_texels =
        family.extra == ExtraInput::blurred || family.extra == ExtraInput::seen || family.both_kinds;
    if (by_texels) {
      if (maps[i].texels) add_cells(family, maps[i], i, points);
    } else if (family.extra == ExtraInput::none ||
               (family.extra == ExtraInput::expected_seen && maps[i].expected_seen) ||
               (family.extra == ExtraInput::deep_seen && maps[i].deep_seen)) {
      add_bins(family, maps[i], i, points);
    }
  }
  return points;
}

LeastSquaresFit fit_family(const FormFamily& family, const std::vector<FitPoint>& points,
                           const std::vector<double>& map_weights, std::vector<VectorXd> starts) {
  const std::size_t albedos = points.empty() ? 1 : points[0].albedos.size();
  std::vector<const FitPoint*> used;
  double weight_sum = 0;
  for (const FitPoint& point : points) {
    if (map_weights[point.map] <= 0) continue;
    used.push_back(&point);
    weight_sum += point.weight * map_weights[point.map] * static_cast<double>(albedos);
  }
  const VectorXd published = to_parameters(family.published);
  const double prior = family.prior_error * std::sqrt(static_cast<double>(albedos));
  const auto residuals = [&](const VectorXd& parameters, VectorXd& left) {
    Eigen::Index i = 0;
    for (const FitPoint* point : used) {
      const double root = std::sqrt(point->weight * map_weights[point->map]);
      for (std::size_t k = 0; k < albedos; ++k) {
        left[i++] =
            root * (family.evaluate(parameters, point->inputs, point->albedos[k]) - point->measured[k]);
      }
    }
    for (Eigen::Index p = 0; i < left.size(); ++p) left[i++] = prior * (parameters[p] / published[p] - 1);
  };
  const ResidualShape shape{.groups = static_cast<Eigen::Index>(used.size()),
                            .group_size = static_cast<Eigen::Index>(albedos),
                            .priors = prior > 0 ? published.size() : 0,
                            .weight_sum = weight_sum};
  if (starts.empty()) {
    starts.push_back(published);
    for (const std::vector<double>& start : family.more_starts) starts.push_back(to_parameters(start));
  }
  std::optional<LeastSquaresFit> best;
  std::string fault;
  for (const VectorXd& start : starts) {
    try {
      const std::string pole = find_pole(family, used, start);
      if (!pole.empty()) throw Error("the fit of " + family.name + ": the form " + pole);
      LeastSquaresFit fit = fit_least_squares(family.name, start, shape, residuals);
      if (!best || fit.rms < best->rms) best = std::move(fit);
    } catch (const Error& error) {
      if (fault.empty()) fault = error.what();
    }
  }
  if (!best) throw Error(fault);
  return *best;
}

}  // namespace heightlight
