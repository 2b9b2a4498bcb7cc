#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "heightlight/models.h"
#include "models/judged_map.h"
#include "models/least_squares.h"

namespace heightlight {

/// What a family's form is to reproduce.
enum class FitTarget {
  direct,         ///< E₀/π over α or A
  first_bounce,   ///< E₁/π at ρ = 1
  total,          ///< of all bounces, ρ = 0.1 … 0.9
  three_bounces,  ///< E₀ + ρE₁ + ρ²E₂ + ρ³E₃, at the albedos of file 000, appendix B
};

/// A form whose parameters are fitted: name, formula, parameters with their published values (those of this
/// project, for its own forms), from which fits start.
struct FormFamily {
  std::string name;
  std::string formula;
  std::string source;
  AoKind kind = AoKind::sky_view_factor;
  ExtraInput extra = ExtraInput::none;
  FitTarget target = FitTarget::total;
  std::vector<std::string> parameters;
  std::vector<double> published;
  std::function<double(const Eigen::VectorXd& parameters, const ModelInputs&, double albedo)> evaluate;
};

/// The inputs with what the family itself finds out about the map, given its parameters: t, for
/// ExtraInput::deep_seen.
ModelInputs tune_inputs(const FormFamily& family, const Eigen::VectorXd& parameters,
                        const SeenMoments& moments, ModelInputs inputs);

/// All families: the notes' F₀ and F₁, Jimenez' cubic of three and of all bounces, and those of G(A, n, ρ).
const std::vector<FormFamily>& form_families();

/// Something to fit to: a bin of a map's curves, or a cell of its texels.
struct FitPoint {
  ModelInputs inputs;
  double weight = 0;  ///< its share of the map's texels, so that maps count alike
  std::size_t map = 0;
  SeenMoments moments;           ///< of its map
  std::vector<double> measured;  ///< one per albedo of the target
};

/// The albedos of a target; a single 1 where it has none.
const std::vector<double>& target_albedos(FitTarget target);

/// Points of the maps that have what the family needs: bins of curves, or cells of 1/24 × 1/24 of A and the
/// extra input where that varies over the map.
std::vector<FitPoint> collect_points(const FormFamily& family, const std::vector<JudgedMap>& maps);

/// Least squares over the points, each weighed by `map_weight` of its map too; maps of weight 0 are left out.
LeastSquaresFit fit_family(const FormFamily& family, const std::vector<FitPoint>& points,
                           const std::vector<double>& map_weights);

/// 95 % intervals of the parameters.
struct ParameterIntervals {
  std::string unit;  ///< what was drawn: "materials", or "bins" where there are fewer than four of those
  int draws = 0;
  Eigen::VectorXd low;
  Eigen::VectorXd high;
};

/// Bootstrap: fits to as many materials (or points) as there are, drawn with replacement; 2.5 % and 97.5 % of
/// what comes out. Draws whose fit fails are left out; throws Error where that is more than a tenth of them.
ParameterIntervals bootstrap_family(const FormFamily& family, const std::vector<FitPoint>& points,
                                    const std::vector<JudgedMap>& maps, const Eigen::VectorXd& best,
                                    int draws, std::uint64_t seed);

}  // namespace heightlight
