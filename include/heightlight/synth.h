#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "heightlight/image.h"

namespace heightlight {

/// A shape that the project can make: its name on the command line, and one line that says what it is.
struct SynthShape {
  std::string name;
  std::string description;
  bool tiles;  ///< the map repeats without a seam
};

/// flat, plane, bowl, trench, groove, cliff, steps, sines, shapes, fbm, cobbles, brick, concrete; in this
/// order.
const std::vector<SynthShape>& synth_shapes();

/// Heights in [0, 1], `size` × `size`, texel centres at ((column + ½)/size, (row + ½)/size); the same for the
/// same arguments on every machine and for any number of threads. The exact formula of each analytic shape
/// stands above its function. `seed` matters to fbm, cobbles, brick and concrete. Throws UsageError for an
/// unknown name (it lists the known ones) or a size outside [1, 32768].
Image<float> synthesize(const std::string& shape, int size, std::uint64_t seed);

/// `fbm`, some rows at a time: the same heights, of maps that memory need not hold.
class FbmRows {
 public:
  /// Makes all rows once, for their range. Throws UsageError for a size outside [1, 65536].
  FbmRows(int size, std::uint64_t seed);

  /// Rows [first, first + count).
  Image<float> rows(int first, int count) const;

 private:
  int size_;
  std::uint64_t seed_;
  float lowest_;
  float range_;
};

}  // namespace heightlight
