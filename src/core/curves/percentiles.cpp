#include "curves/percentiles.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <span>

#include "base/parallel.h"
#include "curves/value_buckets.h"

namespace heightlight {
namespace {

constexpr std::size_t kFewTexels = 2048;
constexpr std::uint32_t kCoarse = ValueBuckets::kCoarse;
constexpr std::uint32_t kFine = ValueBuckets::kFine;
constexpr std::uint32_t kNotSought = std::numeric_limits<std::uint32_t>::max();

using Counts = std::vector<std::uint32_t>;

/// Reads all blocks on all threads and calls visit(values of the block, counts), each thread with counts of
/// its own; gives their sum. Numbers of texels add up to the same in any order.
template <class T, class Visit>
Counts count_texels(const BinGroups& groups, const T* map, std::size_t size, Visit&& visit) {
  std::vector<Counts> of_threads(std::min(groups.block_count(), static_cast<std::size_t>(thread_count())));
  std::atomic<std::size_t> next{0};
  parallel_for(static_cast<std::int64_t>(of_threads.size()), [&](std::int64_t i) {
    Counts& own = of_threads[static_cast<std::size_t>(i)];
    own.resize(size, 0);
    GroupedBlock<T> values(groups);
    for (std::size_t block = next++; block < groups.block_count(); block = next++) {
      values.read(block, map);
      visit(values, own.data());
    }
  });
  Counts sum(size, 0);
  for (const Counts& own : of_threads) {
    for (std::size_t i = 0; i < size; ++i) sum[i] += own[i];
  }
  return sum;
}

/// The values of all bins with few texels, in whatever order the threads come upon them.
template <class T>
class FewTexels {
 public:
  explicit FewTexels(const std::vector<std::size_t>& counts) {
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (counts[k] > kFewTexels) continue;
      bins_.push_back(k);
      begins_.push_back(values_.size());
      values_.resize(values_.size() + counts[k]);
    }
    begins_.push_back(values_.size());
    kept_ = std::vector<std::atomic<std::size_t>>(bins_.size());
  }

  void keep(const GroupedBlock<T>& block) {
    for (std::size_t i = 0; i < bins_.size(); ++i) {
      const std::span<const T> group = block[bins_[i]];
      if (group.empty()) continue;
      const std::size_t place = begins_[i] + kept_[i].fetch_add(group.size());
      std::copy(group.begin(), group.end(), values_.begin() + static_cast<std::ptrdiff_t>(place));
    }
  }

  void set_percentiles(std::vector<Percentiles>& of_bins) {
    parallel_for(static_cast<std::int64_t>(bins_.size()), [&](std::int64_t n) {
      const auto i = static_cast<std::size_t>(n);
      of_bins[bins_[i]] =
          exact_percentiles(std::span(values_).subspan(begins_[i], begins_[i + 1] - begins_[i]));
    });
  }

 private:
  std::vector<std::size_t> bins_;
  std::vector<std::size_t> begins_;  ///< of each bin's values, and the end of the last
  std::vector<T> values_;
  std::vector<std::atomic<std::size_t>> kept_;  ///< of each bin's values
};

/// A bin with many texels. Its coarse buckets are counted first, then the fine ones of those coarse buckets
/// in which an order statistic is that was asked for.
class FullBin {
 public:
  FullBin(std::size_t bin, std::size_t texels, const Moments& moments)
      : bin_(bin), texels_(texels), buckets_(moments.least, moments.greatest) {
    fine_begin_.fill(kNotSought);
  }

  std::size_t bin() const { return bin_; }

  template <class T>
  void count_coarse(std::span<const T> group, std::uint32_t* counts) const {
    for (const T value : group) ++counts[buckets_.bucket(static_cast<double>(value)) / kFine];
  }

  /// Finds the order statistics in the coarse counts. The fine counts of their buckets stand from `end` on,
  /// which moves behind them.
  void seek(const std::uint32_t* coarse, std::uint32_t& end) {
    std::uint32_t bucket = 0;
    std::size_t before = 0;
    auto found = found_.begin();
    for (const double share : kPercentileShares) {
      const PercentilePlace place(share, texels_);
      for (const std::size_t rank : {place.lower, place.upper}) {
        while (before + coarse[bucket] <= rank) before += coarse[bucket++];
        if (fine_begin_[bucket] == kNotSought) {
          fine_begin_[bucket] = end;
          end += kFine;
        }
        *found++ = {bucket, rank - before};
      }
    }
  }

  template <class T>
  void count_fine(std::span<const T> group, std::uint32_t* counts) const {
    // First those that count, without a branch: which they are can hardly be predicted.
    std::array<std::uint16_t, BinGroups::kBlockTexels> kept;
    std::size_t count = 0;
    for (const T value : group) {
      const std::uint16_t bucket = buckets_.bucket(static_cast<double>(value));
      kept[count] = bucket;
      count += fine_begin_[bucket / kFine] != kNotSought;
    }
    for (std::size_t i = 0; i < count; ++i) ++counts[fine_begin_[kept[i] / kFine] + kept[i] % kFine];
  }

  Percentiles percentiles(const std::uint32_t* fine) const {
    Percentiles result{};
    for (std::size_t s = 0; s < result.size(); ++s) {
      const PercentilePlace place(kPercentileShares[s], texels_);
      result[s] = place.between(value(found_[2 * s], fine), value(found_[2 * s + 1], fine));
    }
    return result;
  }

 private:
  struct Found {
    std::uint32_t coarse = 0;
    std::size_t rank = 0;  ///< among the texels of the coarse bucket
  };

  /// As if the texels of a fine bucket were spread evenly over it.
  double value(const Found& found, const std::uint32_t* fine) const {
    const std::uint32_t* counts = fine + fine_begin_[found.coarse];
    std::uint32_t bucket = 0;
    std::size_t before = 0;
    while (before + counts[bucket] <= found.rank) before += counts[bucket++];
    const double part = (static_cast<double>(found.rank - before) + 0.5) / counts[bucket];
    return buckets_.value(found.coarse * kFine + bucket, part);
  }

  std::size_t bin_;
  std::size_t texels_;
  ValueBuckets buckets_;
  std::array<Found, 2 * kPercentileShares.size()> found_{};  ///< lower and upper of each percentile
  std::array<std::uint32_t, kCoarse> fine_begin_;            ///< of each coarse bucket, where it is sought
};

}  // namespace

template <class T>
std::vector<Percentiles> bin_percentiles(const BinGroups& groups, const T* map,
                                         const std::vector<Moments>& moments) {
  const std::vector<std::size_t>& texels = groups.counts();
  FewTexels<T> few(texels);
  std::vector<FullBin> full;
  for (std::size_t k = 0; k < texels.size(); ++k) {
    if (texels[k] > kFewTexels) full.emplace_back(k, texels[k], moments[k]);
  }
  using Block = GroupedBlock<T>;
  const Counts coarse =
      count_texels(groups, map, full.size() * kCoarse, [&](const Block& block, std::uint32_t* counts) {
        few.keep(block);
        for (std::size_t i = 0; i < full.size(); ++i) {
          full[i].count_coarse(block[full[i].bin()], counts + i * kCoarse);
        }
      });
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < full.size(); ++i) full[i].seek(coarse.data() + i * kCoarse, end);
  std::vector<Percentiles> result(texels.size());
  few.set_percentiles(result);
  if (full.empty()) return result;
  const Counts fine = count_texels(groups, map, end, [&](const Block& block, std::uint32_t* counts) {
    for (const FullBin& bin : full) bin.count_fine(block[bin.bin()], counts);
  });
  for (const FullBin& bin : full) result[bin.bin()] = bin.percentiles(fine.data());
  return result;
}

template std::vector<Percentiles> bin_percentiles(const BinGroups& groups, const float* map,
                                                  const std::vector<Moments>& moments);
template std::vector<Percentiles> bin_percentiles(const BinGroups& groups, const double* map,
                                                  const std::vector<Moments>& moments);

}  // namespace heightlight
