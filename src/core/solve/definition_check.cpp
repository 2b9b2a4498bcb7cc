#include <cmath>
#include <optional>

#include "base/hash.h"
#include "base/parallel.h"
#include "solve/definitions.h"

namespace heightlight {
namespace {

constexpr int kCheckedReceivers = 256;
constexpr int kCheckedAzimuths = 256;

}  // namespace

std::vector<double> check_horizon_means(const Surface& surface, const std::vector<Map>& found,
                                        const MeansGoal& goal, const Watch& watch) {
  const ExactWalker walker(surface, kCheckedAzimuths, exact_maximum_distance(goal.maximum_distance));
  std::vector<std::optional<HorizonTerms<double>>> squares(kCheckedReceivers);
  Progress progress("check of horizons", kCheckedReceivers, watch);
  parallel_for(
      kCheckedReceivers,
      [&](std::int64_t i) {
        const std::uint64_t pick = hash_combine(goal.seed + 3, static_cast<std::uint64_t>(i));
        const std::size_t texel = pick % surface.map.height.size();
        if (std::isnan(surface.map.height.values[texel])) return;
        const auto width = static_cast<std::size_t>(surface.width());
        const HorizonTerms<double> exact =
            exact_horizon_means(walker, static_cast<int>(texel / width), static_cast<int>(texel % width));
        HorizonTerms<double>& square = squares[static_cast<std::size_t>(i)].emplace();
        for (std::size_t k = 0; k < found.size(); ++k) {
          const double error =
              double{found[k].values[texel]} - exact[static_cast<std::size_t>(goal.means[k])];
          square[k] = error * error;
        }
      },
      &progress);
  HorizonTerms<double> sum{};
  int receivers = 0;
  for (const std::optional<HorizonTerms<double>>& square : squares) {
    if (!square) continue;
    ++receivers;
    for (std::size_t k = 0; k < found.size(); ++k) sum[k] += (*square)[k];
  }
  if (receivers == 0) return {};
  std::vector<double> errors;
  for (std::size_t k = 0; k < found.size(); ++k) errors.push_back(std::sqrt(sum[k] / receivers));
  return errors;
}

}  // namespace heightlight
