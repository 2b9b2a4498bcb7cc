#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/watch.h"
#include "shading/compared_skies.h"
#include "shading/directional_methods.h"
#include "shading/receivers.h"

namespace heightlight {

struct DirectionalStudyOptions {
  std::vector<NamedSky> skies = compared_skies();
  std::uint64_t memory = ~0ULL;  ///< bytes that finding baked maps may take
  std::uint64_t seed = 1;
  Watch watch = {};
};

/// Relative errors are of the truth, or of this where there is less, E/π: a receiver that hardly gets light
/// does not decide.
constexpr double kLeastLight = 0.01;

/// One line of the table.
struct DirectionalRow {
  std::string sky = {};
  bool as_harmonics = false;  ///< the truth is of the sky as nine harmonics have it, not of the sky itself
  std::string input = {};     ///< whose openness
  std::string method = {};
  double mrse = 0;  ///< mean relative squared error, of E/π over receivers and channels
  double rmse = 0;
  double bias = 0;
};

/// What shading costs.
struct ShadingCost {
  std::string method = {};
  double nanoseconds = 0;  ///< per texel and channel, on one processor
  long arithmetic = 0;     ///< operations per texel and channel; 0 where they are not counted
  long functions = 0;      ///< roots among them
  int lookups = 0;         ///< of the sky
};

/// A picture of a window in the map's middle.
struct ShadedPicture {
  std::string sky = {};
  std::string method = {};  ///< empty: the truth
  double mrse = 0;
  Image<Vector3> light = {};  ///< E/π, red, green and blue; NaN where the sample is missing
};

struct DirectionalStudy {
  ReceiverGrid grid = {};
  std::vector<DirectionalRow> rows = {};
  std::vector<ShadingCost> costs = {};
  std::vector<ShadedPicture>
      pictures;  ///< by exact openness, against the sky itself; per sky the truth first
  std::vector<ConeFormError> forms = {};
};

/// Compares ways to shade under skies that are not even, by directions: against exact horizons, with openness
/// that is exact, baked, or GTAO's. Throws what solve throws.
DirectionalStudy study_directional(const Surface& surface, const DirectionalStudyOptions& options);

}  // namespace heightlight
