#pragma once

#include <vector>

#include "fit/form_family.h"
#include "fit/judged_map.h"
#include "fit/least_squares.h"

namespace heightlight {

/// Something to fit to: a bin of a map's curves, a cell of its texels, or a texel.
struct FitPoint {
  ModelInputs inputs;
  double weight = 0;  ///< its share of the map's texels, so that maps count alike
  std::size_t map = 0;
  std::vector<double> albedos;   ///< as many for every point
  std::vector<double> measured;  ///< at each of them
};

/// Points of the maps that have what the family needs: bins of curves where it is a function of one kind of
/// AO, beside numbers of the map; else cells of 1/24 of each input that varies over the map.
std::vector<FitPoint> collect_points(const FormFamily& family, const std::vector<JudgedMap>& maps);

/// Least squares over the points, each weighed by `map_weight` of its map too; maps of weight 0 are left out.
/// Begins at each of `starts`, those of the family where there are none, and keeps the best. Throws Error as
/// fit_least_squares does, and where the family has no finite value at a point, wherever it begins.
LeastSquaresFit fit_family(const FormFamily& family, const std::vector<FitPoint>& points,
                           const std::vector<double>& map_weights, std::vector<Eigen::VectorXd> starts = {});

}  // namespace heightlight
