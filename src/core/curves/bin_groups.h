#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "heightlight/image.h"

namespace heightlight {

/// The texels of a map by AO bin. The map is cut into blocks whose values fit a core's cache, and each texel
/// knows its place among those of its block, grouped by bin: two bytes a texel, and two for each filled bin
/// in a block.
class BinGroups {
 public:
  static constexpr std::size_t kBlockTexels = 16384;  ///< the last block may have fewer

  /// `ao` and `bins` as in CurveBuilder, which checks them.
  BinGroups(const Map& ao, int bins);

  /// The bins that have texels, ascending. All below and all statistics name a bin by its index k in it.
  const std::vector<int>& filled() const { return filled_; }
  const std::vector<std::size_t>& counts() const { return counts_; }  ///< texels of each
  std::size_t texel_count() const { return places_.size(); }
  std::size_t block_count() const { return (texel_count() + kBlockTexels - 1) / kBlockTexels; }

  /// Where each of the block's texels stands in it; missing ones behind the last group.
  std::span<const std::uint16_t> places(std::size_t block) const;

  /// The place where each bin's group begins in the block, and where the last one ends.
  std::span<const std::uint16_t> begins(std::size_t block) const;

 private:
  std::vector<int> filled_;
  std::vector<std::size_t> counts_;
  std::vector<std::uint16_t> places_;
  std::vector<std::uint16_t> begins_;
};

/// What a map of T says in one block after the other, grouped by bin.
template <class T>
class GroupedBlock {
 public:
  explicit GroupedBlock(const BinGroups& groups) : groups_(groups), values_(BinGroups::kBlockTexels) {}

  /// The map is read straight through, as memory likes it; only the copy in the cache is filled at random.
  void read(std::size_t block, const T* map) {
    const std::span<const std::uint16_t> places = groups_.places(block);
    const T* texels = map + block * BinGroups::kBlockTexels;
    for (std::size_t i = 0; i < places.size(); ++i) values_[places[i]] = texels[i];
    begins_ = groups_.begins(block);
  }

  /// The values of bin k's texels, which may be none.
  std::span<const T> operator[](std::size_t k) const {
    return std::span<const T>(values_).subspan(begins_[k], begins_[k + 1] - begins_[k]);
  }

 private:
  const BinGroups& groups_;
  std::vector<T> values_;
  std::span<const std::uint16_t> begins_;
};

}  // namespace heightlight
