#pragma once

#include <string>
#include <vector>

#include "comparison/contenders.h"
#include "comparison/error_statistics.h"
#include "comparison/form_panels.h"
#include "comparison/reference.h"
#include "comparison/rendered_forms.h"

namespace heightlight {

/// What is compared: the names of quantities as they stand in the table.
inline constexpr const char* kSkyQuantity = "sky_view_factor";
inline constexpr const char* kOcclusionQuantity = "ambient_occlusion";
inline constexpr const char* kBentQuantity = "bent_normal_deg";  ///< angles, in degrees
std::string total_quantity(const ComparedAlbedo& albedo);        ///< "total_irradiance_0.5"

/// One line of the table.
struct ComparisonRow {
  std::string method = {};
  std::string parameters = {};
  std::string variant = {};  ///< what was made of the method's result: a closed form's name; empty: nothing
  std::string quantity = {};
  Cost cost = {};                ///< of that quantity: what a method finds beside it costs nothing here
  double samples_per_texel = 0;  ///< depths or rays; 0 where a method does not count them
  ErrorStatistics error = {};
  double outside_share = 0;  ///< of the texels that have AO: outside a closed form's domain, and in no error
  bool shown = false;        ///< of a representative method
};

/// The method whose rows say what closed forms err by where they are fed the reference's own AO.
inline constexpr const char* kExactMethod = "exact AO";

/// What a map differs by from the reference's.
struct ErrorMap {
  std::string title = {};     ///< the method
  std::string subtitle = {};  ///< its parameters, or the form that was applied
  ErrorStatistics error = {};
  Map differences = {};
};

/// A contender that stands at the head of the report.
struct RoleOfMethod {
  std::string role;
  std::string method;
  std::string parameters;
  double core_seconds = 0;  ///< for its AO
};

/// What a method of several stages takes for each.
struct StageCost {
  std::string method;
  std::string parameters;
  double occlusion_core_seconds = 0;             ///< AO, and direct irradiance from it
  std::vector<double> bounce_core_seconds = {};  ///< beside that, per albedo
};

struct Comparison {
  std::vector<ComparisonRow> rows;
  std::vector<ErrorMap> shown;           ///< of A, of the contenders that are shown
  std::vector<RoleOfMethod> roles;       ///< exact AO first
  std::vector<ErrorMap> total_errors;    ///< at the last albedo: role by role, form by form; thinned
                                         ///< out, 0 × 0 where the role's AO does not tell what a form wants
  std::vector<FormPanel> panels;         ///< of the exact AO, then of GTAO as games run it
  std::vector<RenderedForm> rendered;    ///< likewise
  std::vector<RenderedForm> directions;  ///< A of GTAO by 1, 16 and 96 directions, and the exact one
  std::vector<RenderedForm> sky_light;   ///< direct irradiance of the reference's sky: the exact one first
  std::vector<StageCost> stages;
};

/// Runs all contenders and compares them with the reference: A, α, the bent normal and the totals, as far as
/// each has them. The closed forms are tried on every method's own A (or α, as they want), and on the
/// reference's.
Comparison compare_methods(const ComparedScene& scene, const ComparisonReference& reference,
                           const std::vector<Contender>& contenders, const Watch& watch);

}  // namespace heightlight
