#include "curves/bin_groups.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace heightlight {
namespace {

/// Exact: a float times at most 10000 fits a double. Clamped because an AO summed from floats may pass its
/// range by rounding, and so that 1 falls in the last bin. Missing texels come behind it, in bin `bins`.
std::uint16_t bin_of(float ao, int bins) {
  const double scaled = static_cast<double>(ao) * bins;
  return static_cast<std::uint16_t>(std::isnan(ao) ? bins : std::clamp(scaled, 0.0, bins - 1.0));
}

/// Sets the texels' places in their block, and adds up how many are in each bin.
void group_block(std::span<const float> ao, int bins, std::span<std::uint16_t> places,
                 std::span<std::uint16_t> counts) {
  for (std::size_t i = 0; i < ao.size(); ++i) {
    places[i] = bin_of(ao[i], bins);
    ++counts[places[i]];
  }
  std::vector<std::uint16_t> next(counts.size(), 0);  // where each bin's next texel goes
  for (std::size_t bin = 1; bin < counts.size(); ++bin) {
    next[bin] = static_cast<std::uint16_t>(next[bin - 1] + counts[bin - 1]);
  }
  for (std::uint16_t& place : places) place = next[place]++;
}

}  // namespace

BinGroups::BinGroups(const Map& ao, int bins) : places_(ao.size()) {
  const std::size_t groups = static_cast<std::size_t>(bins) + 1;  // the last of missing texels
  std::vector<std::uint16_t> sizes(block_count() * groups, 0);
  parallel_for(static_cast<std::int64_t>(block_count()), [&](std::int64_t i) {
    const auto block = static_cast<std::size_t>(i);
    const std::size_t first = block * kBlockTexels;
    const std::size_t texels = std::min(kBlockTexels, ao.size() - first);
    group_block(std::span(ao.values).subspan(first, texels), bins, std::span(places_).subspan(first, texels),
                std::span(sizes).subspan(block * groups, groups));
  });
  std::vector<std::size_t> totals(groups, 0);
  for (std::size_t i = 0; i < sizes.size(); ++i) totals[i % groups] += sizes[i];
  for (std::size_t bin = 0; bin + 1 < groups; ++bin) {
    if (totals[bin] == 0) continue;
    filled_.push_back(static_cast<int>(bin));
    counts_.push_back(totals[bin]);
  }
  begins_.reserve(block_count() * (filled_.size() + 1));
  for (std::size_t block = 0; block < block_count(); ++block) {
    std::uint16_t end = 0;
    for (const int bin : filled_) {
      begins_.push_back(end);
      end = static_cast<std::uint16_t>(end + sizes[block * groups + static_cast<std::size_t>(bin)]);
    }
    begins_.push_back(end);
  }
}

std::span<const std::uint16_t> BinGroups::places(std::size_t block) const {
  const std::size_t first = block * kBlockTexels;
  return std::span(places_).subspan(first, std::min(kBlockTexels, places_.size() - first));
}

std::span<const std::uint16_t> BinGroups::begins(std::size_t block) const {
  const std::size_t size = filled_.size() + 1;
  return std::span(begins_).subspan(block * size, size);
}

}  // namespace heightlight
