#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/transport.h"
#include "transport/error_propagation.h"

namespace heightlight {

/// Errors of single bounces, found while these are made, by exact walks of some receivers. The residual of
/// E_b is r = E_b − F E_{b−1}, and its error is e_b = r + F e_{b−1}, with means of e over classes of
/// receivers as in error_propagation.h.
class BounceCheck {
 public:
  /// `direct` is A per texel, as it was found; `seed` picks the receivers. The surface must outlive this
  /// object.
  BounceCheck(const Surface& surface, const TexelVector& direct, std::uint64_t seed, const Watch& watch);

  /// Returns the RMSE of E_b/π. To be called for b = 0, 1, 2 … in order. 0 where there is no receiver.
  double take(const TexelVector& bounce);

  /// Bytes that a check of a map of that size holds.
  static std::uint64_t bytes(int width, int height);

 private:
  struct Receiver {
    std::size_t texel;
    SliceView view;
    FoundError found;
    double gathered;  ///< F E_{b−1}
  };

  const Surface& surface_;
  std::vector<Receiver> receivers_;
  SkyClasses::PerClass<double> mean_{};  ///< mean of e_{b−1} per class
};

}  // namespace heightlight
