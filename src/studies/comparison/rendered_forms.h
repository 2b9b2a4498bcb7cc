#pragma once

#include <array>
#include <string>
#include <vector>

#include "comparison/contenders.h"
#include "comparison/error_statistics.h"

namespace heightlight {

/// The surface as it looks under the even sky, with some word for its light: what it reflects, albedo × E/π,
/// linear.
struct RenderedForm {
  std::string title = {};  ///< whose AO
  std::string label = {};  ///< the form; "no AO", or "truth"
  double rmse = 0;         ///< of E/π over all channels; 0 of the truth
  std::array<Map, 3> reflected =
      {};  ///< red, green, blue, thinned out; 0 × 0 where the AO does not tell what a form wants
};

/// In colour where the scene's albedos are the channels of a colour (R, G, B), else grey at the last albedo:
/// without any AO, by each form at the head of the report, and as it is.
std::vector<RenderedForm> render_forms(const std::string& role, const Estimate& estimate,
                                       const ComparedScene& scene, const ComparisonReference& reference);

}  // namespace heightlight
