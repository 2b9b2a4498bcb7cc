#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "heightlight/closed_forms.h"

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
  std::vector<std::string> parameters = {};
  std::vector<double> published = {};
  std::function<double(const Eigen::VectorXd& parameters, const ModelInputs&, double albedo)> evaluate = {};
};

/// Whether its constants stand in a paper; those of this project's own forms are defaults.
bool is_published(const FormFamily& family);

/// The inputs with what the family itself finds out about the map, given its parameters: t, for
/// ExtraInput::deep_seen.
ModelInputs tune_inputs(const FormFamily& family, const Eigen::VectorXd& parameters,
                        const SeenMoments& moments, ModelInputs inputs);

/// All families: the notes' F₀ and F₁, Jimenez' cubic of three and of all bounces, and those of G(A, n, ρ).
const std::vector<FormFamily>& form_families();

/// The albedos of a target; a single 1 where it has none.
const std::vector<double>& target_albedos(FitTarget target);

}  // namespace heightlight
