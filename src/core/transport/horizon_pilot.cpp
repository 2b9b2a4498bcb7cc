#include "transport/horizon_pilot.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "visibility/horizon_sky.h"
#include "visibility/sky_walk.h"
#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

constexpr int kRows = 8;
constexpr int kColumns = 16;
constexpr std::size_t kBlocksPerStrip = 1;
constexpr std::size_t kExactPerBlock = 5;

/// Strips of a map of that size: bricks and joints take turns, and the larger the map the fewer of them a
/// strip meets. What the pilot costs grows with the map's side, what it plans with the square.
std::int64_t strip_count(int width, int height) {
  constexpr double kStrips = 48;
  constexpr double kSide = 1024;
  const double side = std::sqrt(static_cast<double>(width) * height);
  return static_cast<std::int64_t>(std::ceil(kStrips * std::max(1.0, side / kSide)));
}

/// All tiles, in strips of kRows rows and kColumns columns.
std::vector<TileFrame> cut_strips(const Surface& surface) {
  const TileGrid tiles(surface.width(), surface.height());
  std::vector<TileFrame> strips;
  for (std::int64_t i = 0; i < tiles.count(); ++i) {
    const TileFrame tile = tiles.frame(i);
    for (int row = 0; row < tile.rows; row += kRows) {
      for (int column = 0; column < tile.columns; column += kColumns) {
        strips.push_back({.first_row = tile.first_row + row,
                          .first_column = tile.first_column + column,
                          .rows = std::min(kRows, tile.rows - row),
                          .columns = std::min(kColumns, tile.columns - column)});
      }
    }
  }
  return strips;
}

/// Receivers that gathers walk together, of a strip.
TileFrame pick_block(const TileFrame& strip, std::uint64_t pick) {
  const int down = (strip.rows + kGatherBlockRows - 1) / kGatherBlockRows;
  const int across = (strip.columns + kGatherBlock - 1) / kGatherBlock;
  const int i = static_cast<int>(pick % static_cast<std::uint64_t>(down * across));
  const int row = i / across * kGatherBlockRows;
  const int column = i % across * kGatherBlock;
  return {.first_row = strip.first_row + row,
          .first_column = strip.first_column + column,
          .rows = std::min(kGatherBlockRows, strip.rows - row),
          .columns = std::min(kGatherBlock, strip.columns - column)};
}

double root_mean(double squares, std::size_t count) {
  return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0;
}

/// A of an exact view by every other azimuth; NaN where the sample is missing.
double sky_by_even_azimuths(const ExactWalker& walker, const Vector3& normal, const SliceView& view) {
  const Eigen::Vector3d n = as_eigen(normal).cast<double>().normalized();
  SkyShareSum sky;
  for (std::size_t k = 0; k < view.horizon_rad.size(); k += 2) {
    const double azimuth = walker.azimuth_rad(static_cast<int>(k));
    sky.add({n.x() * std::cos(azimuth) + n.y() * std::sin(azimuth), n.z()}, std::tan(view.horizon_rad[k]));
  }
  return sky.value();
}

/// x by texel, 0 where it is missing.
auto finite_values(const Map& x) {
  return [&x](std::size_t i) { return std::isnan(x.values[i]) ? 0.0 : double{x.values[i]}; };
}

}  // namespace

std::uint64_t horizon_pilot_bytes(int width, int height) {
  const auto receivers =
      static_cast<std::uint64_t>(strip_count(width, height)) * kBlocksPerStrip * kExactPerBlock;
  return height_mips_bytes(width, height) +
         receivers * slice_view_bytes(width, height, HorizonPilot::kExactAzimuths);
}

double root_mean_square(const std::vector<double>& errors) {
  double squares = 0;
  for (const double error : errors) squares += error * error;
  return root_mean(squares, errors.size());
}

HorizonPilot::HorizonPilot(const Surface& surface, std::uint64_t seed, const Watch& watch,
                           BelowHorizontal below)
    : surface_(surface),
      below_(below),
      trial_watch_{.tell = {}, .stopped = watch.stopped},
      mips_(build_height_mips(surface)) {
  const std::vector<TileFrame> strips = cut_strips(surface);
  const auto count = static_cast<std::int64_t>(strips.size());
  const std::int64_t wanted = std::min(strip_count(surface.width(), surface.height()), count);
  for (std::int64_t i = 0; i < wanted; ++i) {
    // One from each of as many equal parts of the map.
    const std::int64_t begin = count * i / wanted;
    const std::int64_t end = count * (i + 1) / wanted;
    const std::uint64_t pick = hash_combine(seed, static_cast<std::uint64_t>(i));
    frames_.push_back(strips[static_cast<std::size_t>(
        begin + static_cast<std::int64_t>(pick % static_cast<std::uint64_t>(end - begin)))]);
  }
  for (std::size_t j = 0; j < frames_.size() * kBlocksPerStrip; ++j)
    blocks_.push_back(pick_block(frames_[j / kBlocksPerStrip], hash_combine(seed + 2, j)));
  const ExactWalker walker(surface, kExactAzimuths);
  std::vector<ExactReceiver> receivers(blocks_.size() * kExactPerBlock);
  Progress progress("pilot", static_cast<std::int64_t>(receivers.size()), watch);
  parallel_for(
      static_cast<std::int64_t>(receivers.size()),
      [&](std::int64_t i) {
        ExactReceiver& receiver = receivers[static_cast<std::size_t>(i)];
        receiver.block = static_cast<std::size_t>(i) / kExactPerBlock;
        receiver.frame = receiver.block / kBlocksPerStrip;
        const TileFrame& block = blocks_[receiver.block];
        // One from each of as many equal parts: all of them, where there are no more.
        const std::uint64_t part = static_cast<std::uint64_t>(i) % kExactPerBlock;
        const auto texels = static_cast<std::uint64_t>(block.rows * block.columns);
        const std::uint64_t begin = texels * part / kExactPerBlock;
        const std::uint64_t end = std::max(begin + 1, texels * (part + 1) / kExactPerBlock);
        const auto pick =
            static_cast<int>(begin + hash_combine(seed + 1, static_cast<std::uint64_t>(i)) % (end - begin));
        const int row = block.first_row + pick / block.columns;
        const int column = block.first_column + pick % block.columns;
        receiver.row = row - frames_[receiver.frame].first_row;
        receiver.column = column - frames_[receiver.frame].first_column;
        walker.view(row, column, receiver.view);
        receiver.view.links.shrink_to_fit();
        receiver.even_sky = sky_by_even_azimuths(walker, surface.normal(row, column), receiver.view);
      },
      &progress);
  std::erase_if(receivers,
                [](const ExactReceiver& receiver) { return std::isnan(receiver.view.sky_view_factor); });
  exact_ = std::move(receivers);
}

std::size_t HorizonPilot::in_strips(const ExactReceiver& receiver) {
  return receiver.frame * WalkTile::kTexels +
         static_cast<std::size_t>(receiver.row * TileFrame::kSide + receiver.column);
}

std::size_t HorizonPilot::texel_of(const ExactReceiver& receiver) const {
  const TileFrame& frame = frames_[receiver.frame];
  return surface_.map.height.index(frame.first_row + receiver.row, frame.first_column + receiver.column);
}

std::vector<float> HorizonPilot::walk_sky_of(const WalkOptions& options, BelowHorizontal below,
                                             EvenWalk* even) {
  std::vector<AzimuthTable> azimuths;
  for (int k = 0; k < options.azimuths; ++k) {
    azimuths.push_back(make_azimuth_table(surface_, options, azimuth_rad(options, k)));
  }
  const int rings = ring_count(surface_, options);
  constexpr std::size_t kBlocks = SkyBlocks().size();
  std::vector<float> result(frames_.size() * WalkTile::kTexels);
  if (even) {
    even->sky.resize(result.size());
    even->shares.resize(frames_.size() * kBlocks);
  }
  Progress progress("trial", static_cast<std::int64_t>(frames_.size()), trial_watch_);
  parallel_for(
      static_cast<std::int64_t>(frames_.size()),
      [&](std::int64_t i) {
        const auto strip = static_cast<std::size_t>(i);
        const auto tile = std::make_unique<WalkTile>();
        const auto sums = std::make_unique<SkySums>();
        sums->below = below;
        sums->steep = steep_slope(static_cast<int>(azimuths.size()) / (even ? 2 : 1));
        const auto far = std::make_unique<FarView>();
        tile->load(surface_, mips_, options, rings, frames_[strip]);
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

SamplingError HorizonPilot::sampling_error(int fineness, float peak_share) {
  EvenWalk even;
  const std::vector<float> walked =
      walk_sky_of({kExactAzimuths, fineness, peak_share}, BelowHorizontal::sky, &even);
  double squares = 0;
  double own = 0;
  for (const ExactReceiver& receiver : exact_) {
    const std::size_t at = in_strips(receiver);
    const double error = double{walked[at]} - receiver.view.sky_view_factor;
    const double even_error = double{even.sky[at]} - receiver.even_sky;
    squares += error * error;
    own += (even_error - error) * (even_error - error);  // half the halves' difference: of the mean of both
  }
  return {root_mean(std::max(squares - own, 0.0), exact_.size()),
          root_mean(kExactAzimuths * own, exact_.size())};
}

const std::vector<float>& HorizonPilot::many_like(const WalkOptions& options) {
  if (many_.empty() || many_options_.fineness != options.fineness ||
      many_options_.peak_share != options.peak_share) {
    many_options_ = options;
    many_options_.azimuths = kManyAzimuths;
    many_ = walk_sky_of(many_options_, below_);
  }
  return many_;
}

double HorizonPilot::azimuth_error(const WalkOptions& options) {
  const std::vector<float>& many = many_like(options);
  const std::vector<float> few = walk_sky_of(options, below_);
  double squares = 0;
  std::size_t count = 0;
  for (std::size_t at = 0; at < few.size(); ++at) {
    if (few[at] < 0) continue;
    squares += double{few[at] - many[at]} * double{few[at] - many[at]};
    ++count;
  }
  return root_mean(squares, count);
}

HorizonPilot::Sparse HorizonPilot::find_sparse(const WalkOptions& options, double error) {
  struct Block {
    double share = 0;
    double loss = 0;  // squared errors of every other azimuth less those of all
    int receivers = 0;
  };
  constexpr std::size_t kBlocks = SkyBlocks().size();
  const std::vector<float>& many = many_like(options);
  EvenWalk even;
  const std::vector<float> all = walk_sky_of(options, below_, &even);
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

void HorizonPilot::see_classes(const Map& sky, double albedo) {
  const SkyClasses classes(surface_, sky.values, kSkyClassesSeed);
  const auto albedo_of = [albedo](std::size_t) { return albedo; };
  const auto sky_of = [&sky](std::size_t i) { return double{sky.values[i]}; };
  seen_.clear();
  for (const ExactReceiver& receiver : exact_) {
    const double own = sky_of(texel_of(receiver));
    seen_.push_back({.own_class = classes.of(own),
                     .seen = seen_by_class(receiver.view, surface_, classes, albedo_of, sky_of)});
  }
}

double HorizonPilot::sky_effect(const Map& x, double direct_per_sky) const {
  std::vector<double> effects;
  for (const ExactReceiver& receiver : exact_) {
    const double share = 1 - receiver.view.sky_view_factor;
    const double gathered = gather_exactly(receiver.view, surface_, finite_values(x));
    effects.push_back(share > 0 ? direct_per_sky - gathered / share : 0);
  }
  return root_mean_square(effects);
}

double HorizonPilot::gather_sampling_error(const MapGather& gather, const FieldPyramid& pyramid,
                                           const Map& x) {
  assert(seen_.size() == exact_.size());
  Map seen(surface_.width(), surface_.height());
  gather.run_on(blocks_, {.azimuths = kExactAzimuths}, {&pyramid},
                [&](std::size_t, const ReceiverTile& tile, const GatherSums& sums) {
                  for_present(tile, [&](std::size_t at, int row, int column) {
                    seen(row, column) = sums.weight[at] > 0 ? sums.weighted[0][at] / sums.weight[at] : 0;
                  });
                });
  std::vector<FoundError> found = seen_;
  for (std::size_t i = 0; i < exact_.size(); ++i) {
    const ExactReceiver& receiver = exact_[i];
    const double surface_share = 1 - receiver.view.sky_view_factor;
    found[i].residual = surface_share * double{seen.values[texel_of(receiver)]} -
                        gather_exactly(receiver.view, surface_, finite_values(x));
  }
  return root_mean_square(propagate_errors(found));
}

HorizonPilot::AzimuthTrials HorizonPilot::gather_azimuth_errors(const Map& x) const {
  const auto value_of = finite_values(x);
  AzimuthTrials squares{};
  for (const ExactReceiver& receiver : exact_) {
    const SliceView& view = receiver.view;
    std::array<double, kExactAzimuths> weight{};
    std::array<double, kExactAzimuths> weighted{};
    std::size_t link = 0;
    for (std::size_t k = 0; k < kExactAzimuths; ++k) {
      for (; link < view.links_end[k]; ++link) {
        weight[k] += view.links[link].weight;
        weighted[k] += view.links[link].weight * value_seen(view.links[link], surface_, value_of);
      }
    }
    const double own = value_of(texel_of(receiver));
    const double share = 1 - view.sky_view_factor;
    const auto seen_by = [&](std::size_t first, std::size_t by) {
      double sum = 0;
      double all = 0;
      for (std::size_t k = first; k < kExactAzimuths; k += by) {
        sum += weighted[k];
        all += weight[k];
      }
      return all > 0 ? sum / all : own;
    };
    const double many = seen_by(0, 1);
    for (std::size_t trial = 0; trial < kAzimuthTrials; ++trial) {
      const int walked = halved_azimuths(2 << trial, azimuth_halvings(share));
      const auto step = static_cast<std::size_t>(kExactAzimuths / walked);
      double own_squares = 0;
      for (std::size_t first = 0; first < step; ++first)
        own_squares += std::pow(share * (seen_by(first, step) - many), 2);
      squares[trial] += own_squares / static_cast<double>(step);
    }
  }
  AzimuthTrials errors{};
  for (std::size_t trial = 0; trial < kAzimuthTrials; ++trial)
    errors[trial] = root_mean(squares[trial], exact_.size());
  return errors;
}

}  // namespace heightlight
