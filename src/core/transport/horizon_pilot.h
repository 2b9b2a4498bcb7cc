#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "heightlight/transport.h"
#include "transport/error_propagation.h"
#include "transport/map_gather.h"
#include "visibility/exact_walk.h"
#include "visibility/height_mips.h"
#include "visibility/walk_tile.h"

namespace heightlight {

/// 0 of none.
double root_mean_square(const std::vector<double>& errors);

/// An error that azimuths share, and one that each has for itself, of which the mean over many keeps little.
/// Both are RMSE of A; `own` is that of one azimuth.
struct SamplingError {
  double shared = 0;
  double own = 0;

  double at(int azimuths) const { return std::hypot(shared, own / std::sqrt(azimuths)); }
};

/// Bytes that a pilot of such a map holds, most of them for what its receivers see.
std::uint64_t horizon_pilot_bytes(int width, int height);

/// Receivers on which ways of walking are tried before the whole map is walked: strips of tiles, and among
/// them some that are walked exactly too.
class HorizonPilot {
 public:
  /// `surface` must outlive it. The watch hears of the exact walks, and may end trials too. `below`: what few
  /// azimuths cost is tried with that; what sampling costs, of which the horizontal hides but a part, with
  /// the sky.
  HorizonPilot(const Surface& surface, std::uint64_t seed, const Watch& watch,
               BelowHorizontal below = BelowHorizontal::sky);

  bool empty() const { return exact_.empty(); }

  /// RMSE of A against exact walks along the same azimuths: what sampling costs, apart from few azimuths.
  SamplingError sampling_error(int fineness, float peak_share);

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

  /// What the exact receivers see of the surface at an albedo, by its A: `sky` as it was found. Once known,
  /// gathers can be tried.
  void see_classes(const Map& sky, double albedo);

  /// RMS of what a total changes by at the last step for a change of 1 of A: what its direct light does, less
  /// the mean of x seen, the radiosity.
  double sky_effect(const Map& x, double direct_per_sky) const;

  /// RMSE that sampling brings into a total: one gather's, of (1 − A) × the mean of x seen against exact
  /// walks along the same azimuths, and what later gathers make of that. `pyramid` holds x.
  double gather_sampling_error(const MapGather& gather, const FieldPyramid& pyramid, const Map& x);

  /// What 2, 4, 8 and 16 azimuths cost a gather: the same along so many of the exact azimuths, against all of
  /// them, where they are halved as azimuth_halvings says, and who sees nothing along them sees its like.
  static constexpr std::size_t kAzimuthTrials = 4;
  using AzimuthTrials = std::array<double, kAzimuthTrials>;
  AzimuthTrials gather_azimuth_errors(const Map& x) const;

  const Surface& surface() const { return surface_; }

  static constexpr int kExactAzimuths = 48;
  static constexpr int kManyAzimuths = 160;

 private:
  struct ExactReceiver {
    std::size_t block;
    std::size_t frame;  ///< index of its strip
    int row;            ///< in the strip
    int column;
    SliceView view;
    double even_sky;  ///< A by every other azimuth
  };

  /// What every other azimuth tells.
  struct EvenWalk {
    std::vector<float> sky;      ///< A of all receivers of the pilot
    std::vector<double> shares;  ///< surface_share of the blocks of each strip's tile
  };

  std::size_t texel_of(const ExactReceiver& receiver) const;
  /// Its index in what walk_sky_of returns.
  static std::size_t in_strips(const ExactReceiver& receiver);

  /// A of all receivers of the pilot, strip by strip; −1 where there is none.
  std::vector<float> walk_sky_of(const WalkOptions& options, BelowHorizontal below, EvenWalk* even = nullptr);

  /// A by kManyAzimuths walked as the options have it, but for their number.
  const std::vector<float>& many_like(const WalkOptions& options);

  const Surface& surface_;
  BelowHorizontal below_;
  Watch trial_watch_;  ///< is told nothing, and asked whether to go on
  HeightMips mips_;
  std::vector<TileFrame> frames_;  ///< the strips
  std::vector<TileFrame> blocks_;  ///< parts of them, some for each, that hold the exact receivers
  std::vector<ExactReceiver> exact_;
  std::vector<FoundError> seen_;  ///< of the exact receivers: without what they find wrong
  WalkOptions many_options_;
  std::vector<float> many_;  ///< A by kManyAzimuths, made when first asked for
};

}  // namespace heightlight
