#include "fit/fit_points.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace heightlight {
namespace {

using Eigen::VectorXd;

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

}  // namespace

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

}  // namespace heightlight
