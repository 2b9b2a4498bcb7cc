#include "files/level_count.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "base/percentile.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

double median_step(std::vector<double> levels) {
  if (levels.size() < 2) return 0;
  std::sort(levels.begin(), levels.end());
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) levels[i] = levels[i + 1] - levels[i];
  levels.pop_back();
  return percentile(std::span<double>(levels), 0.5);
}

}  // namespace

Levels count_levels(const Image<double>& values) {
  // A hash table with open addressing, large enough to stay sparse, because counting ends at kMostLevels + 1.
  constexpr int kTableBits = 18;
  static_assert(kMostLevels < (std::size_t{1} << kTableBits) / 2);
  constexpr std::size_t kMask = (std::size_t{1} << kTableBits) - 1;
  std::vector<double> table(kMask + 1, std::numeric_limits<double>::quiet_NaN());
  Levels found;
  std::vector<double> few;
  for (const double value : values.values) {
    if (std::isnan(value)) continue;
    // Adding zero turns −0 into 0. The multiplier is 2^64 over the golden ratio (Fibonacci hashing).
    std::size_t slot = (std::bit_cast<std::uint64_t>(value + 0.0) * 0x9e3779b97f4a7c15u) >> (64 - kTableBits);
    while (!std::isnan(table[slot]) && table[slot] != value) slot = (slot + 1) & kMask;
    if (table[slot] == value) continue;
    table[slot] = value;
    if (++found.count > kMostLevels) break;
    if (found.count <= kFewLevels) few.push_back(value);
  }
  if (found.count <= kFewLevels) found.step = median_step(std::move(few));
  return found;
}

}  // namespace heightlight
