#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/transport.h"
#include "transport/error_propagation.h"

namespace heightlight {

/// What single bounces err by, found while they are made, on some receivers by exact walks: of E_b one finds
/// r = E_b − F E_{b−1}, and e_b = r + F e_{b−1} as error_propagation.h has it.
class BounceCheck {
 public:
  /// `direct` is A per texel, as found; `seed` picks the receivers. The surface must outlive it.
  BounceCheck(const Surface& surface, const TexelVector& direct, std::uint64_t seed, const Watch& watch);

  /// RMSE of E_b/π, for b = 0, 1, 2 …, one after the other. 0 where there is no receiver.
  double take(const TexelVector& bounce);

  /// What it holds on a map of that size.
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
  SkyClasses::PerClass<double> mean_{};  ///< of e_{b−1}
};

}  // namespace heightlight
