#pragma once

#include <map>
#include <string>
#include <vector>

#include "comparison/contenders.h"
#include "comparison/error_statistics.h"
#include "comparison/rendered_forms.h"

namespace heightlight {

/// What is made of AO: it is multiplied by what an open plane receives that faces along the normal, or along
/// the bent normal.
inline constexpr const char* kByNormal = "by normal";
inline constexpr const char* kByBentNormal = "by bent normal";

/// Pictures show so much of E/π: slopes toward a sun are brighter than a level plane.
inline constexpr float kSkyExposure = 0.6F;

/// What some word for the light of a sky errs by.
struct SkyLightResult {
  std::string variant;  ///< what was made of AO; empty: the method's own
  Cost cost;
  ErrorStatistics error;  ///< of E/π, its three channels together
  RenderedForm rendered;
};

/// Compares direct irradiance under the reference's sky, which is prepared once: renderers have it so.
class SkyComparison {
 public:
  explicit SkyComparison(const ComparisonReference& reference);

  /// By normal, as AO has it, and by bent normal where there is one (Jimenez et al. 2016, section 5).
  std::vector<SkyLightResult> compare_occlusion(const Contender& contender, const Estimate& estimate,
                                                const Surface& surface, Cost cost) const;

  /// A method's own, timed.
  SkyLightResult compare_own(const Contender& contender);

  /// How it is.
  RenderedForm exact() const;

 private:
  SkyLightResult result(const Contender& contender, const std::string& variant, const Image<Vector3>& light,
                        Cost cost) const;

  const ComparisonReference& reference_;
  SkyLight open_;                    ///< prefiltered
  std::map<double, SkyGrid> grids_;  ///< by solid angle
};

}  // namespace heightlight
