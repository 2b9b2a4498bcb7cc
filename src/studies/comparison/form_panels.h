#pragma once

#include <array>
#include <string>
#include <vector>

#include "comparison/contenders.h"

namespace heightlight {

/// Texels of like AO.
struct PanelBin {
  double ao = 0;  ///< mean
  double mean = 0;
  double low = 0;  ///< 5 % of the texels are below
  double high = 0;
};

/// A form as a curve: AO and E/π, at the means of bins.
struct PanelCurve {
  std::string form;                           ///< as in the list of closed forms
  std::string label;                          ///< as readers know it
  std::vector<std::array<double, 2>> points;  ///< NaN where the form has no value
};

/// E/π over one kind of AO at one albedo: as the reference has it, and as forms of that AO would.
struct FormPanel {
  std::string role;  ///< whose AO it is
  AoKind kind = AoKind::sky_view_factor;
  std::string albedo;
  std::vector<PanelBin> measured = {};
  std::vector<PanelCurve> curves = {};
};

/// The forms of comparisons' heads, under the names that readers know: AO × π, the notes', the two of Jimenez
/// et al. 2016 and G, then a user's own.
struct AnsweringForm {
  std::string form;
  std::string label;
};
std::vector<AnsweringForm> answering_forms(const std::vector<ClosedForm>& forms);

/// A panel for each albedo and kind of AO that the estimate has; bins with few texels are left out.
std::vector<FormPanel> make_form_panels(const std::string& role, const Estimate& estimate,
                                        const ComparedScene& scene, const ComparisonReference& reference);

}  // namespace heightlight
