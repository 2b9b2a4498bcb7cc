#include "transport/gather_calibration.h"

#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "base/root_mean.h"
#include "transport/exact_gather.h"

namespace heightlight {
namespace {

constexpr CalibrationShape kBlock{.rows = kGatherBlockRows, .columns = kGatherBlock};
constexpr double kBlocks = 192;  // of a map of 1024²
constexpr std::size_t kExactPerBlock = 4;

/// Azimuths of a trial of sampling: about as many as all gathers have together.
constexpr int kTrialAzimuths = 16;
constexpr std::size_t kTrialStep = GatherCalibration::kExactAzimuths / kTrialAzimuths;

std::int64_t block_count(int width, int height) {
  return static_cast<std::int64_t>(std::ceil(kBlocks * std::sqrt(calibration_scale(width, height))));
}

}  // namespace

std::uint64_t gather_calibration_bytes(int width, int height, std::uint64_t fields) {
  constexpr int kAzimuths = GatherCalibration::kExactAzimuths;
  const auto receivers = static_cast<std::uint64_t>(block_count(width, height)) * kExactPerBlock;
  return receivers *
         (slice_view_bytes(width, height, kAzimuths) + fields * sizeof(GatherCalibration::SeenField));
}

GatherCalibration::GatherCalibration(const Surface& surface, const CalibrationOptions& options)
    : surface_(surface),
      watch_{.tell = {}, .stopped = options.watch.stopped},
      blocks_(
          pick_frames(surface, kBlock, block_count(surface.width(), surface.height()), options.seed + 2)) {
  const ExactWalker walker(surface, kExactAzimuths);
  exact_.resize(blocks_.size() * kExactPerBlock);
  Progress progress("calibration of gathers", static_cast<std::int64_t>(exact_.size()), options.watch);
  parallel_for(
      static_cast<std::int64_t>(exact_.size()),
      [&](std::int64_t i) {
        ExactReceiver& receiver = exact_[static_cast<std::size_t>(i)];
        receiver.block = static_cast<std::size_t>(i) / kExactPerBlock;
        const TileFrame& block = blocks_[receiver.block];
        const FrameTexel texel = pick_in_frame(block, static_cast<std::uint64_t>(i) % kExactPerBlock,
                                               kExactPerBlock, options.seed + 3 + receiver.block);
        receiver.texel = surface.map.height.index(texel.row, texel.column);
        receiver.in_block = static_cast<std::size_t>((texel.row - block.first_row) * kGatherBlock +
                                                     texel.column - block.first_column);
        walker.view(texel.row, texel.column, receiver.view);
        receiver.view.links.shrink_to_fit();
      },
      &progress);
  std::erase_if(exact_,
                [](const ExactReceiver& receiver) { return std::isnan(receiver.view.sky_view_factor); });
}

void GatherCalibration::see_classes(const Map& sky, double albedo) {
  const SkyClasses classes(surface_, sky.values, kSkyClassesSeed);
  const auto albedo_of = [albedo](std::size_t) { return albedo; };
  const auto sky_of = [&sky](std::size_t i) { return double{sky.values[i]}; };
  seen_.clear();
  for (const ExactReceiver& receiver : exact_) {
    const double own = sky_of(receiver.texel);
    seen_.push_back({.own_class = classes.of(own),
                     .seen = seen_by_class(receiver.view, surface_, classes, albedo_of, sky_of)});
  }
}

double GatherCalibration::SeenField::mean(std::size_t first, std::size_t step) const {
  double sum = 0;
  double all = 0;
  for (std::size_t k = first; k < kExactAzimuths; k += step) {
    sum += weighted[k];
    all += weight[k];
  }
  return all > 0 ? sum / all : own;
}

std::vector<GatherCalibration::SeenField> GatherCalibration::see_field(const Map& x) const {
  const auto value_of = [&x](std::size_t i) { return std::isnan(x.values[i]) ? 0.0 : double{x.values[i]}; };
  std::vector<SeenField> seen;
  for (const ExactReceiver& receiver : exact_) {
    SeenField& field = seen.emplace_back();
    field.own = value_of(receiver.texel);
    std::size_t link = 0;
    for (std::size_t k = 0; k < kExactAzimuths; ++k) {
      for (; link < receiver.view.links_end[k]; ++link) {
        const VisibleInterval& interval = receiver.view.links[link];
        field.weight[k] += interval.weight;
        field.weighted[k] += interval.weight * value_seen(interval, surface_, value_of);
      }
    }
  }
  return seen;
}

double GatherCalibration::sky_effect(const std::vector<SeenField>& radiosity, double direct_per_sky) const {
  std::vector<double> effects;
  for (std::size_t i = 0; i < exact_.size(); ++i)
    effects.push_back(surface_share(i) > 0 ? direct_per_sky - radiosity[i].mean() : 0);
  return root_mean_square(effects);
}

double GatherCalibration::sampling_error(const MapGather& gather, const FieldPyramid& pyramid,
                                         const std::vector<SeenField>& x) const {
  assert(seen_.size() == exact_.size() && x.size() == exact_.size());
  std::vector<std::array<double, std::size_t{kGatherBlock} * kGatherBlockRows>> walked(blocks_.size());
  gather.run_on(
      blocks_, {.azimuths = kTrialAzimuths, .turn = 0.25 / kTrialStep}, {&pyramid},
      [&](std::size_t block, const ReceiverTile& tile, const GatherSums& sums) {
        for_present(tile, [&](std::size_t at, int row, int column) {
          const int in_block =
              (row - blocks_[block].first_row) * kGatherBlock + column - blocks_[block].first_column;
          if (sums.weight[at] > 0) {
            walked[block][static_cast<std::size_t>(in_block)] =
                double{sums.weighted[0][at]} / double{sums.weight[at]};
          }
        });
      },
      watch_);
  std::vector<FoundError> found = seen_;
  for (std::size_t i = 0; i < exact_.size(); ++i) {
    const double mean = walked[exact_[i].block][exact_[i].in_block];
    found[i].residual = surface_share(i) * (mean - x[i].mean(0, kTrialStep));
  }
  return root_mean_square(propagate_errors(found));
}

GatherCalibration::AzimuthTrials GatherCalibration::azimuth_errors(const std::vector<SeenField>& x) const {
  AzimuthTrials squares{};
  for (std::size_t i = 0; i < exact_.size(); ++i) {
    const double share = surface_share(i);
    const double many = x[i].mean();
    for (std::size_t trial = 0; trial < kAzimuthTrials; ++trial) {
      const int walked = halved_azimuths(2 << trial, azimuth_halvings(share));
      const auto step = static_cast<std::size_t>(kExactAzimuths / walked);
      double own = 0;
      for (std::size_t first = 0; first < step; ++first)
        own += std::pow(share * (x[i].mean(first, step) - many), 2);
      squares[trial] += own / static_cast<double>(step);
    }
  }
  AzimuthTrials errors{};
  for (std::size_t trial = 0; trial < kAzimuthTrials; ++trial)
    errors[trial] = root_mean(squares[trial], exact_.size());
  return errors;
}

}  // namespace heightlight
