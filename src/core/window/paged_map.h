#pragma once

#include <vector>

#include "window/stored_map.h"

namespace heightlight {

/// Samples of a stored map one by one. Squares of them are kept when they were read, each thread its own, as
/// many as `bytes` for each hold. At most as many threads as there are when it is made may ask.
class PagedMap {
 public:
  PagedMap(const StoredMap& stored, std::uint64_t bytes);

  float at(int row, int column) const;

 private:
  static constexpr int kPageBits = 6;
  static constexpr int kPageSide = 1 << kPageBits;

  struct Page {
    std::int64_t number = -1;
    std::vector<float> samples;
  };
  using Pages = std::vector<Page>;  ///< a page has one place, by its number

  void read_page(std::int64_t number, Page& page) const;

  const StoredMap& stored_;
  std::int64_t across_;
  mutable std::vector<Pages> pages_;  ///< [thread]
};

}  // namespace heightlight
