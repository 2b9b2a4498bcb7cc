#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hash.h"
#include "base/parallel.h"
#include "solve/definitions.h"

namespace heightlight {
namespace {

/// Receivers of the trial: some of each of so many blocks.
constexpr int kBlocks = 64;
constexpr int kBlockSide = WalkTile::kWideGroup;
constexpr int kPerBlock = 4;

/// Azimuths along which they are walked exactly, and by which power of their number the error falls: that of
/// horizons with jumps, as for A.
constexpr int kTriedAzimuths = 48;
constexpr double kAzimuthOrder = 1.5;
constexpr int kFewestAzimuths = 8;
constexpr int kMostAzimuths = 720;

/// Of the error wanted, what is aimed at, since few receivers are not the map: with this, what was reached
/// was 0.08 to 1.08 times the error wanted on a DEM, a DSM, bricks and fractal ground. And of what is aimed
/// at, the share that sampling may take.
constexpr double kAim = 0.8;
constexpr double kSamplingShare = 0.8;

/// A receiver that is walked exactly, and its means by all azimuths and by every other one.
struct TrialReceiver {
  std::size_t block;
  int row;  ///< in the block
  int column;
  HorizonTerms<double> all;
  HorizonTerms<double> even;
};

/// Receivers from all over the map on which walks are tried.
class Trial {
 public:
  Trial(const Surface& surface, const HeightPyramid& pyramid, const MeansGoal& goal, const Watch& watch)
      : surface_(surface), pyramid_(pyramid), goal_(goal), watch_{.tell = {}, .stopped = watch.stopped} {
    pick_blocks();
    find_exactly(watch);
  }

  bool empty() const { return receivers_.empty(); }

  /// RMSE against exact walks along the same azimuths, of the mean that errs most.
  double sampling_error(const WalkOptions& options) const;

  /// RMSE of so many exact azimuths, of the mean that errs most.
  double azimuth_error(int azimuths) const {
    // Every other azimuth errs by what all of them err by, and by its own part.
    const double half = largest_rmse([](const TrialReceiver& receiver, std::size_t mean) {
      return receiver.even[mean] - receiver.all[mean];
    });
    const double own = 1 / std::sqrt(1 - std::pow(0.25, kAzimuthOrder));
    return half * own * std::pow(0.5 * kTriedAzimuths / azimuths, kAzimuthOrder);
  }

 private:
  void pick_blocks() {
    const int across = (surface_.width() + kBlockSide - 1) / kBlockSide;
    const int down = (surface_.height() + kBlockSide - 1) / kBlockSide;
    const std::int64_t count = std::int64_t{across} * down;
    const std::int64_t wanted = std::min<std::int64_t>(kBlocks, count);
    for (std::int64_t i = 0; i < wanted; ++i) {
      // One from each of as many equal parts of the map.
      const std::int64_t begin = count * i / wanted;
      const std::int64_t end = count * (i + 1) / wanted;
      const std::uint64_t pick = hash_combine(goal_.seed + 7, static_cast<std::uint64_t>(i));
      const std::int64_t block =
          begin + static_cast<std::int64_t>(pick % static_cast<std::uint64_t>(end - begin));
      const int row = static_cast<int>(block / across) * kBlockSide;
      const int column = static_cast<int>(block % across) * kBlockSide;
      blocks_.push_back({.first_row = row,
                         .first_column = column,
                         .rows = std::min(kBlockSide, surface_.height() - row),
                         .columns = std::min(kBlockSide, surface_.width() - column)});
    }
  }

  void find_exactly(const Watch& watch) {
    const ExactWalker walker(surface_, kTriedAzimuths, exact_maximum_distance(goal_.maximum_distance));
    std::vector<std::optional<TrialReceiver>> found(blocks_.size() * kPerBlock);
    Progress progress("calibration of horizons", static_cast<std::int64_t>(found.size()), watch);
    parallel_for(
        static_cast<std::int64_t>(found.size()),
        [&](std::int64_t i) {
          const std::size_t block = static_cast<std::size_t>(i) / kPerBlock;
          const TileFrame& frame = blocks_[block];
          const auto texels = static_cast<std::uint64_t>(frame.rows * frame.columns);
          const auto pick =
              static_cast<int>(hash_combine(goal_.seed + 8, static_cast<std::uint64_t>(i)) % texels);
          const int row = pick / frame.columns;
          const int column = pick % frame.columns;
          if (std::isnan(surface_.map.height(frame.first_row + row, frame.first_column + column))) return;
          TrialReceiver receiver{.block = block, .row = row, .column = column, .all = {}, .even = {}};
          const auto terms = exact_horizon_terms(walker, frame.first_row + row, frame.first_column + column);
          for (std::size_t k = 0; k < terms.size(); ++k) {
            for (std::size_t mean = 0; mean < kHorizonMeans; ++mean) {
              receiver.all[mean] += terms[k][mean] / kTriedAzimuths;
              if (k % 2 == 0) receiver.even[mean] += 2 * terms[k][mean] / kTriedAzimuths;
            }
          }
          found[static_cast<std::size_t>(i)] = receiver;
        },
        &progress);
    for (const std::optional<TrialReceiver>& receiver : found) {
      if (receiver) receivers_.push_back(*receiver);
    }
  }

  template <class Error>
  double largest_rmse(Error&& error) const {
    double largest = 0;
    for (const HorizonMean mean : goal_.means) {
      double squares = 0;
      for (const TrialReceiver& receiver : receivers_) {
        const double found = error(receiver, static_cast<std::size_t>(mean));
        squares += found * found;
      }
      largest = std::max(largest, squares);
    }
    return std::sqrt(largest / static_cast<double>(receivers_.size()));
  }

  const Surface& surface_;
  const HeightPyramid& pyramid_;
  const MeansGoal& goal_;
  Watch watch_;  ///< is told nothing, and asked whether to go on
  std::vector<TileFrame> blocks_;
  std::vector<TrialReceiver> receivers_;
};

double Trial::sampling_error(const WalkOptions& options) const {
  WalkOptions tried = options;
  tried.azimuths = kTriedAzimuths;
  const std::vector<HorizonBlock> walked =
      walk_horizon_blocks(surface_, pyramid_, tried, blocks_, goal_.maximum_distance, watch_);
  return largest_rmse([&](const TrialReceiver& receiver, std::size_t mean) {
    const auto at = static_cast<std::size_t>(receiver.row * kBlockSide + receiver.column);
    return double{walked[receiver.block][mean][at]} - receiver.all[mean];
  });
}

double cost_of(const WalkOptions& options) { return options.azimuths * (5.0 + options.samples_per_octave); }

}  // namespace

WalkOptions plan_horizon_means(const Surface& surface, const HeightPyramid& pyramid, const MeansGoal& goal,
                               const Watch& watch) {
  WalkOptions best;
  if (goal.azimuths > 0) best.azimuths = goal.azimuths;
  const Trial trial(surface, pyramid, goal, watch);
  if (trial.empty()) return best;
  const double error = kAim * goal.error;
  double least = std::numeric_limits<double>::infinity();
  double least_sampling = least;
  float share = 0;  // of the peaks, the best so far: finer walks want the same, or more
  for (const int samples_per_octave : {8, 12, 16, 24, 32, 48, 64, 96, 128}) {
    WalkOptions options{
        .azimuths = kFewestAzimuths, .samples_per_octave = samples_per_octave, .peak_share = share};
    double sampling = trial.sampling_error(options);
    for (const float more : {0.15F, 0.3F, 0.45F, 0.6F}) {
      if (more <= share) continue;
      options.peak_share = more;
      const double found = trial.sampling_error(options);
      if (found >= sampling) break;
      sampling = found;
      share = more;
    }
    options.peak_share = share;
    const bool good = sampling <= kSamplingShare * error;
    const double rest = std::sqrt(std::max(error * error - sampling * sampling, 0.25 * error * error));
    while (trial.azimuth_error(options.azimuths) > rest && options.azimuths < kMostAzimuths)
      options.azimuths += 2;
    if (goal.azimuths > 0) options.azimuths = goal.azimuths;
    const double cost = cost_of(options);
    if (std::isfinite(least) && (!good || cost >= least)) break;
    if (!good && sampling >= least_sampling) continue;
    if (good) least = cost;
    least_sampling = sampling;
    best = options;
  }
  return best;
}

}  // namespace heightlight
