#include "transport/sky_calibration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "base/parallel.h"
#include "base/root_mean.h"
#include "base/texel_algebra.h"
#include "visibility/exact_walk.h"
#include "visibility/sky_walk.h"
#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

constexpr CalibrationShape kStrip{.rows = 8, .columns = 16};
constexpr double kStrips = 48;  // of a map of 1024²
constexpr std::size_t kExactPerStrip = 5;

std::int64_t strip_count(int width, int height) {
  return static_cast<std::int64_t>(std::ceil(kStrips * calibration_scale(width, height)));
}

/// A of an exact view from every other azimuth; NaN where the sample is missing.
double sky_by_even_azimuths(const ExactWalker& walker, const Vector3& normal, const SliceView& view) {
  const Eigen::Vector3d n = as_eigen(normal).cast<double>().normalized();
  SkyShareSum sky;
  for (std::size_t k = 0; k < view.horizon_rad.size(); k += 2) {
    const double azimuth = walker.azimuth_rad(static_cast<int>(k));
    sky.add({n.x() * std::cos(azimuth) + n.y() * std::sin(azimuth), n.z()}, std::tan(view.horizon_rad[k]));
  }
  return sky.value();
}

}  // namespace

std::uint64_t sky_calibration_bytes(int width, int height) {
  constexpr std::uint64_t kWalks = 3;  // by many azimuths, by those tried, and by every other of those tried
  const auto strips = static_cast<std::uint64_t>(strip_count(width, height));
  return strips * WalkTile::kTexels * kWalks * sizeof(float);
}

SkyCalibration::SkyCalibration(const Surface& surface, const HeightPyramid& pyramid,
                               const CalibrationOptions& options)
    : surface_(surface),
      pyramid_(pyramid),
      below_(options.below),
      trial_watch_{.tell = {}, .stopped = options.watch.stopped},
      strips_(pick_frames(surface, kStrip, strip_count(surface.width(), surface.height()), options.seed)) {
  const ExactWalker walker(surface, kExactAzimuths);
  std::vector<std::optional<ExactReceiver>> found(strips_.size() * kExactPerStrip);
  Progress progress("calibration", static_cast<std::int64_t>(found.size()), options.watch);
  parallel_for(
      static_cast<std::int64_t>(found.size()),
      [&](std::int64_t i) {
        const auto strip = static_cast<std::size_t>(i) / kExactPerStrip;
        const TileFrame& frame = strips_[strip];
        const FrameTexel texel = pick_in_frame(frame, static_cast<std::uint64_t>(i) % kExactPerStrip,
                                               kExactPerStrip, options.seed + 1 + strip);
        SliceView view;
        walker.view(texel.row, texel.column, view);
        if (std::isnan(view.sky_view_factor)) return;
        const int in_tile =
            (texel.row - frame.first_row) * TileFrame::kSide + texel.column - frame.first_column;
        found[static_cast<std::size_t>(i)] = {
            .at = strip * WalkTile::kTexels + static_cast<std::size_t>(in_tile),
            .sky = view.sky_view_factor,
            .even_sky = sky_by_even_azimuths(walker, surface.normal(texel.row, texel.column), view)};
      },
      &progress);
  for (const std::optional<ExactReceiver>& receiver : found) {
    if (receiver) exact_.push_back(*receiver);
  }
}

std::vector<float> SkyCalibration::walk_strips(const WalkOptions& options, BelowHorizontal below,
                                               EvenWalk* even) {
  std::vector<AzimuthTable> azimuths;
  for (int k = 0; k < options.azimuths; ++k) {
    azimuths.push_back(make_azimuth_table(surface_, options, azimuth_rad(options, k)));
  }
  const int rings = ring_count(surface_, options);
  constexpr std::size_t kBlocks = SkyBlocks().size();
  std::vector<float> result(strips_.size() * WalkTile::kTexels);
  if (even) {
    even->sky.resize(result.size());
    even->shares.resize(strips_.size() * kBlocks);
  }
  Progress progress("trial", static_cast<std::int64_t>(strips_.size()), trial_watch_);
  parallel_for(
      static_cast<std::int64_t>(strips_.size()),
      [&](std::int64_t i) {
        const auto strip = static_cast<std::size_t>(i);
        const auto tile = std::make_unique<WalkTile>();
        const auto sums = std::make_unique<SkySums>();
        sums->below = below;
        sums->steep = steep_slope(static_cast<int>(azimuths.size()) / (even ? 2 : 1));
        const auto far = std::make_unique<FarView>();
        tile->load(surface_, pyramid_, options, rings, strips_[strip]);
        const auto walk = [&](std::size_t first, std::size_t step) {
          for (std::size_t k = first; k < azimuths.size(); k += step) {
            look_far(*tile, azimuths[k], *far);
            walk_sky(*tile, azimuths[k], *far, *sums);
          }
        };
        const auto write = [&](std::vector<float>& sky) {
          float* out = sky.data() + strip * WalkTile::kTexels;
          for (std::size_t at = 0; at < WalkTile::kTexels; ++at) {
            out[at] = tile->present[at] && sums->full[at] > 0 ? sums->sky[at] / sums->full[at] : -1;
          }
        };
        if (even) {
          walk(0, 2);
          write(even->sky);
          for (std::size_t block = 0; block < kBlocks; ++block) {
            even->shares[strip * kBlocks + block] = surface_share(*tile, *sums, block);
          }
          walk(1, 2);
        } else {
          walk(0, 1);
        }
        write(result);
      },
      &progress);
  return result;
}

SamplingError SkyCalibration::sampling_error(int samples_per_octave, float peak_share) {
  EvenWalk even;
  const std::vector<float> walked =
      walk_strips({kExactAzimuths, samples_per_octave, peak_share}, BelowHorizontal::sky, &even);
  double squares = 0;
  double own = 0;
  for (const ExactReceiver& receiver : exact_) {
    const double error = double{walked[receiver.at]} - receiver.sky;
    const double even_error = double{even.sky[receiver.at]} - receiver.even_sky;
    squares += error * error;
    own += (even_error - error) * (even_error - error);  // half the difference between the two halves of
                                                         // the azimuths: the random error of their mean
  }
  return {root_mean(std::max(squares - own, 0.0), exact_.size()),
          root_mean(kExactAzimuths * own, exact_.size())};
}

const std::vector<float>& SkyCalibration::many_like(const WalkOptions& options) {
  if (many_.empty() || many_options_.samples_per_octave != options.samples_per_octave ||
      many_options_.peak_share != options.peak_share) {
    many_options_ = options;
    many_options_.azimuths = kManyAzimuths;
    many_ = walk_strips(many_options_, below_);
  }
  return many_;
}

double SkyCalibration::azimuth_error(const WalkOptions& options) {
  const std::vector<float>& many = many_like(options);
  const std::vector<float> few = walk_strips(options, below_);
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t at = 0; at < few.size(); ++at) {
    if (few[at] < 0) continue;
    squares += double{few[at] - many[at]} * double{few[at] - many[at]};
    ++count;
  }
  return root_mean(squares, count);
}

SkyCalibration::Sparse SkyCalibration::find_sparse(const WalkOptions& options, double error) {
  struct Block {
    double share = 0;
    double loss = 0;  // squared errors with every other azimuth, less those with all azimuths
    int receivers = 0;
  };
  constexpr std::size_t kBlocks = SkyBlocks().size();
  const std::vector<float>& many = many_like(options);
  EvenWalk even;
  const std::vector<float> all = walk_strips(options, below_, &even);
  std::vector<Block> blocks(even.shares.size());
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t at = 0; at < all.size(); ++at) {
    if (all[at] < 0) continue;
    const auto in_tile = static_cast<int>(at % WalkTile::kTexels);
    Block& block = blocks[at / WalkTile::kTexels * kBlocks +
                          sky_block(in_tile / WalkTile::kSide, in_tile % WalkTile::kSide)];
    const double by_all = double{all[at] - many[at]} * double{all[at] - many[at]};
    const double by_even = double{even.sky[at] - many[at]} * double{even.sky[at] - many[at]};
    squares += by_all;
    block.loss += by_even - by_all;
    ++block.receivers;
    ++count;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) blocks[i].share = even.shares[i];
  std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) { return a.share < b.share; });
  const double most = error * error * static_cast<double>(count);
  double full = static_cast<double>(count);
  for (const Block& block : blocks) {
    if (block.receivers == 0) continue;
    if (squares + block.loss > most) {
      return {block.share, full / static_cast<double>(count), root_mean(squares, count)};
    }
    squares += block.loss;
    full -= block.receivers;
  }
  return {std::numeric_limits<double>::infinity(), 0, root_mean(squares, count)};
}

}  // namespace heightlight
