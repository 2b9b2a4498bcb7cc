#pragma once

#include <cstdint>
#include <vector>

#include "transport/calibration_frames.h"
#include "visibility/height_pyramid.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// An error of A in two parts: `shared` by all azimuths, and each azimuth's `own`, of which the mean over
/// many azimuths keeps little. Both are RMSE of A; `own` is for one azimuth.
struct SamplingError {
  double shared = 0;
  double own = 0;

  double at(int azimuths) const { return std::hypot(shared, own / std::sqrt(azimuths)); }
};

/// Bytes that the calibration of a map of that size holds.
std::uint64_t sky_calibration_bytes(int width, int height);

/// Receivers on which walks of the sky are tried before the whole map is walked: strips of tiles, in which
/// some receivers are also walked exactly.
class SkyCalibration {
 public:
  /// `surface` and `pyramid` must outlive this object. The watch is told of the exact walks, and may end
  /// trials too. `options.below` holds for the trials of few azimuths. The error of sampling is tried with
  /// BelowHorizontal::sky, as the horizontal hides only part of it.
  SkyCalibration(const Surface& surface, const HeightPyramid& pyramid, const CalibrationOptions& options);

  bool empty() const { return exact_.empty(); }

  /// RMSE of A against exact walks along the same azimuths: the error of sampling without that of few
  /// azimuths.
  SamplingError sampling_error(int samples_per_octave, float peak_share);

  /// RMSE of A against kManyAzimuths walked with the same sampling: the error of few azimuths alone.
  double azimuth_error(const WalkOptions& options);

  /// Where every other azimuth suffices. `full_from`: blocks below this surface_share walk every other
  /// azimuth, as in SkyPlan; `full_share`: share of the receivers that walk all azimuths; `error`: the RMSE
  /// of A against kManyAzimuths that results, at most the `error` asked for if all azimuths everywhere keep
  /// to it. `options.azimuths` is a multiple of 4.
  struct Sparse {
    double full_from;
    double full_share;
    double error;
  };
  Sparse find_sparse(const WalkOptions& options, double error);

  static constexpr int kExactAzimuths = 48;
  static constexpr int kManyAzimuths = 160;

 private:
  struct ExactReceiver {
    std::size_t at = 0;   ///< index in what walk_strips returns
    double sky = 1;       ///< A
    double even_sky = 1;  ///< A by every other azimuth
  };

  /// What a walk along every other azimuth finds.
  struct EvenWalk {
    std::vector<float> sky;      ///< A of all receivers of the strips
    std::vector<double> shares;  ///< surface_share of each block of each strip's tile
  };

  /// Returns A of all receivers of the strips, one strip after the other; −1 where there is no receiver.
  std::vector<float> walk_strips(const WalkOptions& options, BelowHorizontal below, EvenWalk* even = nullptr);

  /// Returns A by kManyAzimuths, walked with the other options as given.
  const std::vector<float>& many_like(const WalkOptions& options);

  const Surface& surface_;
  const HeightPyramid& pyramid_;
  BelowHorizontal below_;
  Watch trial_watch_;  ///< reports nothing; asked whether to go on
  std::vector<TileFrame> strips_;
  std::vector<ExactReceiver> exact_;
  WalkOptions many_options_;
  std::vector<float> many_;  ///< A by kManyAzimuths, made at the first call of many_like
};

}  // namespace heightlight
