#include "fit/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/percentile.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

using Eigen::VectorXd;

/// Materials as numbers, per map.
std::vector<std::size_t> number_materials(const std::vector<JudgedMap>& maps, std::size_t& count) {
  std::map<std::string, std::size_t> numbers;
  std::vector<std::size_t> of_map;
  for (const JudgedMap& map : maps)
    of_map.push_back(numbers.emplace(map.material, numbers.size()).first->second);
  count = numbers.size();
  return of_map;
}

/// How often each of `count` things comes up when as many are drawn with replacement.
std::vector<double> draw_with_replacement(std::size_t count, std::uint64_t seed) {
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) {
    times[static_cast<std::size_t>(unit_real(hash_combine(seed, i)) * static_cast<double>(count))] += 1;
  }
  return times;
}

}  // namespace

bool is_determined(const FormFamily& family, const VectorXd& best, const ParameterIntervals& intervals,
                   Eigen::Index parameter) {
  const double size =
      std::max(std::abs(best[parameter]), std::abs(family.published[static_cast<std::size_t>(parameter)]));
  return intervals.high[parameter] - intervals.low[parameter] <= 2 * size;
}

ParameterIntervals bootstrap_family(const FormFamily& family, const std::vector<FitPoint>& points,
                                    const std::vector<JudgedMap>& maps, const VectorXd& best, int draws,
                                    std::uint64_t seed) {
  constexpr std::size_t kFewestMaterials = 4;
  std::size_t materials = 0;
  const std::vector<std::size_t> material_of = number_materials(maps, materials);
  const bool by_material = materials >= kFewestMaterials;
  std::vector<VectorXd> fits(static_cast<std::size_t>(draws));
  parallel_for(draws, [&](std::int64_t draw) {
    const std::uint64_t draw_seed = hash_combine(seed, static_cast<std::uint64_t>(draw));
    std::vector<double> map_weights(maps.size(), 1);
    std::vector<FitPoint> drawn = points;
    if (by_material) {
      const std::vector<double> times = draw_with_replacement(materials, draw_seed);
      for (std::size_t i = 0; i < maps.size(); ++i) map_weights[i] = times[material_of[i]];
    } else {
      const std::vector<double> times = draw_with_replacement(points.size(), draw_seed);
      for (std::size_t i = 0; i < points.size(); ++i) drawn[i].weight *= times[i];
    }
    try {
      fits[static_cast<std::size_t>(draw)] = fit_family(family, drawn, map_weights, {best}).parameters;
    } catch (const Error&) {
      // counted below
    }
  });
  std::erase_if(fits, [](const VectorXd& fit) { return fit.size() == 0; });
  if (static_cast<int>(fits.size()) * 10 < draws * 9) {
    throw Error("the fit of " + family.name + " does not converge for " +
                std::to_string(draws - static_cast<int>(fits.size())) + " of " + std::to_string(draws) +
                " draws of the bootstrap");
  }
  ParameterIntervals intervals{by_material ? "materials" : "bins", static_cast<int>(fits.size()), best, best};
  for (Eigen::Index p = 0; p < best.size(); ++p) {
    std::vector<double> values;
    for (const VectorXd& fit : fits) values.push_back(fit[p]);
    intervals.low[p] = percentile(std::span(values), 0.025);
    intervals.high[p] = percentile(std::span(values), 0.975);
  }
  return intervals;
}

}  // namespace heightlight
