#pragma once

#include <cstdint>
#include <vector>

#include "comparison/answer.h"
#include "comparison/compare_methods.h"
#include "comparison/user_form_fit.h"
#include "user_form/user_form.h"

namespace heightlight {

struct ComparisonOptions {
  std::vector<ComparedAlbedo> albedos;  ///< at least one
  std::vector<UserForm> own_forms = {};
  ComparedSky sky = {};
  int azimuths = 128;            ///< of the reference
  std::uint64_t memory = ~0ULL;  ///< bytes that a method may take
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// All that a comparison on one surface finds: the reference, every method beside it, and the answer. Its
/// parts refer to each other.
struct ComparisonStudy {
  /// Runs it. `surface` must outlive it. Throws UsageError for a bad number of azimuths, and what solve and
  /// fit_on_map throw.
  ComparisonStudy(const Surface& surface, ComparisonOptions options);
  ComparisonStudy(const ComparisonStudy&) = delete;
  ComparisonStudy& operator=(const ComparisonStudy&) = delete;

  std::vector<ComparedAlbedo> albedos;
  Cost depth_cost;  ///< of the depth buffer, which screen-space methods are given
  DepthBuffer depth;
  ComparisonReference reference;
  Map far_field;
  ComparedScene scene;
  std::vector<FormOnMap> own_forms;  ///< of the user, as fitted to the map
  Comparison comparison;
  Answer answer;
};

}  // namespace heightlight
