#pragma once

#include <cstdint>
#include <vector>

#include "transport/calibration_frames.h"
#include "visibility/height_pyramid.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// An error that azimuths share, and one that each has for itself, of which the mean over many keeps little.
/// Both are RMSE of A; `own` is that of one azimuth.
struct SamplingError {
  double shared = 0;
  double own = 0;

  double at(int azimuths) const { return std::hypot(shared, own / std::sqrt(azimuths)); }
};

/// Bytes that a calibration of such a map holds.
std::uint64_t sky_calibration_bytes(int width, int height);

/// Receivers on which walks of the sky are tried before the whole map is walked: strips of tiles, and among
/// them some that are walked exactly too.
class SkyCalibration {
 public:
  /// `surface` and `pyramid` must outlive it. The watch hears of the exact walks, and may end trials too.
  /// `below`: what few azimuths cost is tried with that; what sampling costs, of which the horizontal hides
  /// but a part, with the sky.
  SkyCalibration(const Surface& surface, const HeightPyramid& pyramid, const CalibrationOptions& options);

  bool empty() const { return exact_.empty(); }

  /// RMSE of A against exact walks along the same azimuths: what sampling costs, apart from few azimuths.
  SamplingError sampling_error(int samples_per_octave, float peak_share);

  /// RMSE of A against kManyAzimuths walked alike: what few azimuths cost, apart from sampling.
  double azimuth_error(const WalkOptions& options);

  /// Where every other azimuth will do: the blocks below a surface_share, as SkyPlan has it; the share of the
  /// others, which walk all; and the RMSE of A against kManyAzimuths that this leaves, no more than `error`
  /// where all azimuths everywhere leave no more. `options.azimuths` is a multiple of 4.
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

  /// What every other azimuth tells.
  struct EvenWalk {
    std::vector<float> sky;      ///< A of all receivers of the strips
    std::vector<double> shares;  ///< surface_share of the blocks of each strip's tile
  };

  /// A of all receivers of the strips, one strip after the other; −1 where there is none.
  std::vector<float> walk_strips(const WalkOptions& options, BelowHorizontal below, EvenWalk* even = nullptr);

  /// A by kManyAzimuths walked as the options have it, but for their number.
  const std::vector<float>& many_like(const WalkOptions& options);

  const Surface& surface_;
  const HeightPyramid& pyramid_;
  BelowHorizontal below_;
  Watch trial_watch_;  ///< is told nothing, and asked whether to go on
  std::vector<TileFrame> strips_;
  std::vector<ExactReceiver> exact_;
  WalkOptions many_options_;
  std::vector<float> many_;  ///< A by kManyAzimuths, made when first asked for
};

}  // namespace heightlight
