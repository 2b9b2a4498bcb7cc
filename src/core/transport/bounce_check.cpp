#include "transport/bounce_check.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace heightlight {
namespace {

constexpr std::int64_t kBounceReceivers = 128;
constexpr int kBounceCheckAzimuths = 64;  // they leave an error of .0006 in the first bounce on bricks

std::int64_t receiver_count(const Surface& surface) {
  return std::min(kBounceReceivers, static_cast<std::int64_t>(surface.map.height.size()));
}

}  // namespace

std::uint64_t BounceCheck::bytes(int width, int height) {
  return static_cast<std::uint64_t>(kBounceReceivers) * slice_view_bytes(width, height, kBounceCheckAzimuths);
}

BounceCheck::BounceCheck(const Surface& surface, const TexelVector& direct, std::uint64_t seed,
                         const Watch& watch)
    : surface_(surface), receivers_(static_cast<std::size_t>(receiver_count(surface))) {
  const ExactWalker walker(surface, kBounceCheckAzimuths);
  const SkyClasses classes(surface, direct, seed + 5);
  const std::int64_t count = receiver_count(surface);
  const auto width = static_cast<std::size_t>(surface.width());
  Progress progress("check of the bounces", count, watch);
  parallel_for(
      count,
      [&](std::int64_t i) {
        Receiver& receiver = receivers_[static_cast<std::size_t>(i)];
        receiver.texel = pick_texel(i, count, static_cast<std::int64_t>(direct.size()), seed + 3);
        walker.view(static_cast<int>(receiver.texel / width), static_cast<int>(receiver.texel % width),
                    receiver.view);
        receiver.view.links.shrink_to_fit();
        receiver.gathered = receiver.view.sky_view_factor;
        receiver.found.own_class = classes.of(direct[receiver.texel]);
        const auto one = [](std::size_t) { return 1.0; };
        const auto sky = [&](std::size_t texel) { return direct[texel]; };
        receiver.found.seen = seen_by_class(receiver.view, surface, classes, one, sky);
      },
      &progress);
  std::erase_if(receivers_,
                [](const Receiver& receiver) { return std::isnan(receiver.view.sky_view_factor); });
}

double BounceCheck::take(const TexelVector& bounce) {
  SkyClasses::PerClass<double> sum{};
  SkyClasses::PerClass<double> count{};
  double squares = 0;
  for (const Receiver& receiver : receivers_) {
    double error = bounce[receiver.texel] - receiver.gathered;
    for (std::size_t k = 0; k < mean_.size(); ++k) error += receiver.found.seen[k] * mean_[k];
    squares += error * error;
    sum[receiver.found.own_class] += error;
    count[receiver.found.own_class] += 1;
  }
  for (std::size_t k = 0; k < mean_.size(); ++k) mean_[k] = count[k] > 0 ? sum[k] / count[k] : 0;
  parallel_for(static_cast<std::int64_t>(receivers_.size()), [&](std::int64_t i) {
    Receiver& receiver = receivers_[static_cast<std::size_t>(i)];
    receiver.gathered =
        gather_exactly(receiver.view, surface_, [&](std::size_t texel) { return bounce[texel]; });
  });
  return receivers_.empty() ? 0 : std::sqrt(squares / static_cast<double>(receivers_.size()));
}

}  // namespace heightlight
