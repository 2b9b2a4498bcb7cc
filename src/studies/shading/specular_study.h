#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "heightlight/gloss.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "shading/receivers.h"
#include "shading/specular_methods.h"

namespace heightlight {

/// What specular occlusion is compared at.
struct SpecularStudyOptions {
  std::vector<double> roughness{0.02, 0.13, 0.4};
  std::vector<Vector3> views = {};      ///< toward the viewer; world axes, z > 0; at least one
  std::vector<NamedTable> tables = {};  ///< of GTSO
  int rays = 512;                       ///< of the truth, per receiver
  std::uint64_t memory = ~0ULL;         ///< bytes that finding baked maps may take
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// Texels with less of the sky are called narrow.
constexpr double kNarrowSky = 0.5;

/// One line of the table.
struct SpecularRow {
  std::string input = {};  ///< whose openness; empty where the method takes none
  std::string method = {};
  double roughness = 0;
  std::size_t view = 0;  ///< number of it
  double rmse = 0;       ///< of S, over the receivers that the viewer sees
  double bias = 0;
  double narrow_rmse = 0;  ///< of those with A below kNarrowSky; 0 where there are none
};

/// The truth at one roughness and view.
struct SpecularTruth {
  double roughness = 0;
  std::size_t view = 0;
  std::vector<double> occlusion = {};  ///< per receiver; NaN where the viewer does not see it
  double rmse = 0;                     ///< of it, expected
  double mean = 1;
  std::size_t seen = 0;    ///< receivers
  std::size_t narrow = 0;  ///< of these, with A below kNarrowSky
};

/// A picture of a window in the map's middle.
struct SpecularPicture {
  std::string method = {};  ///< empty: the truth
  double roughness = 0;
  double rmse = 0;  ///< over the window
  Map occlusion = {};
};

/// What a method costs.
struct MethodTime {
  std::string method = {};
  double nanoseconds = 0;  ///< per texel, on one processor
};

struct SpecularStudy {
  ReceiverGrid grid = {};
  std::vector<SpecularTruth> truths = {};
  std::vector<SpecularRow> rows = {};
  std::vector<MethodTime> times = {};
  /// By exact openness, at the view in the middle of the list; per roughness the truth first.
  std::vector<SpecularPicture> pictures = {};
  double fitted_share = 0.01;  ///< u of cone against cone that errs least here, by exact openness
};

/// Compares ways to guess specular occlusion with rays into the lobe, on the receivers of the map that a far
/// viewer sees. Throws UsageError for a roughness outside (0, 1] or a view from below, and what solve throws.
SpecularStudy study_specular(const Surface& surface, const SpecularStudyOptions& options);

}  // namespace heightlight
