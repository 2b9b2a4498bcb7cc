#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "heightlight/closed_forms.h"

namespace heightlight {

/// What a family's form is to reproduce.
enum class FitTarget {
  one_bounce,     ///< E_b/π at ρ = 1, over α or A
  total,          ///< of all bounces, ρ = 0.1 … 0.9
  three_bounces,  ///< E₀ + ρE₁ + ρ²E₂ + ρ³E₃, at the albedos of Jimenez et al. 2016, appendix B
};

/// A form whose parameters are fitted: name, formula, parameters with their published values (those of this
/// project, for its own forms), from which fits start.
struct FormFamily {
  std::string name;
  std::string formula;
  std::string source;
  AoKind kind = AoKind::sky_view_factor;
  ExtraInput extra = ExtraInput::none;
  bool both_kinds = false;  ///< it wants the other kind of AO, too
  bool is_clamped = true;   ///< judged within [0, 1]; fits see it as it is
  FitTarget target = FitTarget::total;
  std::size_t bounce = 0;  ///< b of FitTarget::one_bounce
  std::vector<std::string> parameters = {};
  std::vector<double> published = {};
  /// What is known of the parameters beforehand: one that is off by its published value counts as this RMS
  /// error on one map. It keeps those near that the maps do not determine; 0: nothing is known.
  double prior_error = 0;
  std::vector<std::vector<double>> more_starts = {};  ///< of fits, beside the published values
  std::function<double(const Eigen::VectorXd& parameters, const ModelInputs&, double albedo)> evaluate = {};
};

/// What its constants are before a fit: "published" in a paper, this project's "default", or a mere "start".
const char* origin_of_constants(const FormFamily& family);

/// All families: the notes' F₀ and F₁, Jimenez' cubic of three and of all bounces, and those of G(A, n, ρ).
const std::vector<FormFamily>& form_families();

/// The albedos of a target; a single 1 where it has none.
const std::vector<double>& target_albedos(FitTarget target);

}  // namespace heightlight
