#include "curves/moments.h"

#include <Eigen/Core>
#include <algorithm>
#include <utility>

#include "base/parallel.h"

namespace heightlight {
namespace {

/// Partial results per bin. A number of its own, so that sums do not depend on the threads.
constexpr std::size_t kMostStrips = 64;

/// Some values at a time, for the vector unit.
constexpr std::size_t kLanes = 4;
template <class T>
using Lanes = Eigen::Array<T, kLanes, 1>;

/// Calls visit(Lanes) for all values, the last ones filled up with `filling`.
template <class T, class Visit>
void visit_lanes(std::span<const T> values, T filling, Visit&& visit) {
  std::size_t i = 0;
  for (; i + kLanes <= values.size(); i += kLanes) visit(Eigen::Map<const Lanes<T>>(values.data() + i));
  if (i == values.size()) return;
  Lanes<T> rest = Lanes<T>::Constant(filling);
  std::copy(values.begin() + static_cast<std::ptrdiff_t>(i), values.end(), rest.data());
  visit(rest);
}

template <class T>
std::pair<T, T> range_of(std::span<const T> values) {
  Lanes<T> least = Lanes<T>::Constant(values[0]);
  Lanes<T> greatest = least;
  visit_lanes(values, values[0], [&](const auto& some) {
    least = least.min(some);
    greatest = greatest.max(some);
  });
  return {least.minCoeff(), greatest.maxCoeff()};
}

/// Of at least one value: about the mean at first, then deviations from there, so that no digits cancel.
template <class T>
Moments moments_of(std::span<const T> values) {
  Lanes<double> sums = Lanes<double>::Zero();
  visit_lanes(values, T{0}, [&](const auto& some) { sums += some.template cast<double>(); });
  const double count = static_cast<double>(values.size());
  const T about = static_cast<T>(sums.sum() / count);
  Lanes<double> rests = Lanes<double>::Zero();
  Lanes<double> squares = Lanes<double>::Zero();
  visit_lanes(values, about, [&](const auto& some) {
    const Lanes<double> deviations = some.template cast<double>() - static_cast<double>(about);
    rests += deviations;
    squares += deviations * deviations;
  });
  const double rest = rests.sum();
  const double offset = rest / count;
  const auto [least, greatest] = range_of(values);
  return {count,
          static_cast<double>(about),
          offset,
          std::max(0.0, squares.sum() - rest * offset),
          static_cast<double>(least),
          static_cast<double>(greatest)};
}

/// Of the values of both. The step from the mean of more values to the new one is the smaller, so that even
/// a mean far below some of the values keeps its digits.
Moments merge(const Moments& more, const Moments& fewer) {
  if (more.count < fewer.count) return merge(fewer, more);
  if (fewer.count == 0) return more;
  const double count = more.count + fewer.count;
  const double share = fewer.count / count;
  const double distance = (fewer.about - more.about) + (fewer.offset - more.offset);
  const double offset = more.offset + distance * share;
  const double about = more.about + offset;
  return {count,
          about,
          offset - (about - more.about),
          more.squares + fewer.squares + distance * distance * more.count * share,
          std::min(more.least, fewer.least),
          std::max(more.greatest, fewer.greatest)};
}

}  // namespace

template <class T>
std::vector<Moments> bin_moments(const BinGroups& groups, const T* map) {
  const std::size_t bins = groups.filled().size();
  const std::size_t blocks = groups.block_count();
  const std::size_t strips = std::min(blocks, kMostStrips);
  std::vector<std::vector<Moments>> of_strips(strips, std::vector<Moments>(bins));
  parallel_for(static_cast<std::int64_t>(strips), [&](std::int64_t i) {
    const auto strip = static_cast<std::size_t>(i);
    GroupedBlock<T> values(groups);
    for (std::size_t block = strip * blocks / strips; block < (strip + 1) * blocks / strips; ++block) {
      values.read(block, map);
      for (std::size_t k = 0; k < bins; ++k) {
        if (values[k].empty()) continue;
        Moments& moments = of_strips[strip][k];
        moments = merge(moments, moments_of(values[k]));
      }
    }
  });
  std::vector<Moments> all(bins);
  for (const std::vector<Moments>& strip : of_strips) {
    for (std::size_t k = 0; k < bins; ++k) all[k] = merge(all[k], strip[k]);
  }
  return all;
}

template std::vector<Moments> bin_moments(const BinGroups& groups, const float* map);
template std::vector<Moments> bin_moments(const BinGroups& groups, const double* map);

}  // namespace heightlight
