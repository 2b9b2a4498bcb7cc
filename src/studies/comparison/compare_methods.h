#pragma once

#include <string>
#include <vector>

#include "comparison/contenders.h"
#include "comparison/error_statistics.h"
#include "comparison/reference.h"

namespace heightlight {

/// What is compared: the names of quantities as they stand in the table.
inline constexpr const char* kSkyQuantity = "sky_view_factor";
inline constexpr const char* kOcclusionQuantity = "ambient_occlusion";
inline constexpr const char* kBentQuantity = "bent_normal_deg";  ///< angles, in degrees
/// Irradiance of a sky that is warm (1, 0.6, 0.3) where y > 0 and cold (0.3, 0.6, 1) elsewhere, over its
/// mean.
inline constexpr const char* kTwoToneQuantity = "two_tone_irradiance";
std::string total_quantity(const ComparedAlbedo& albedo);  ///< "total_irradiance_0.5"

/// One line of the table.
struct ComparisonRow {
  std::string method;
  std::string parameters;
  std::string quantity;
  Cost cost;
  double samples_per_texel = 0;  ///< depths or rays; 0 where a method does not count them
  ErrorStatistics error;
};

/// The method whose rows say what closed forms err by where they are fed the reference's own AO.
inline constexpr const char* kExactMethod = "exact AO";

/// A contender's sky view factor − the reference's.
struct ErrorMap {
  std::string method;
  std::string parameters;
  ErrorStatistics error;
  Map differences;
};

struct Comparison {
  std::vector<ComparisonRow> rows;
  std::vector<ErrorMap> shown;
};

/// Runs all contenders and compares them with the reference: A, α, the bent normal and the totals, as far as
/// each has them. Closed forms are tried on the A (or α, as they want) of those that are shown, and of the
/// reference itself.
Comparison compare_methods(const ComparedScene& scene, const ComparisonReference& reference,
                           const std::vector<Contender>& contenders, const Watch& watch);

}  // namespace heightlight
