#include "window/paged_map.h"

#include <algorithm>
#include <cassert>

#include "base/hash.h"
#include "base/parallel.h"

namespace heightlight {

PagedMap::PagedMap(const StoredMap& stored, std::uint64_t bytes)
    : stored_(stored),
      across_((stored.width() + kPageSide - 1) / kPageSide),
      pages_(static_cast<std::size_t>(thread_count())) {
  constexpr std::uint64_t kPageBytes = sizeof(float) * kPageSide * kPageSide;
  const auto count = static_cast<std::size_t>(std::max<std::uint64_t>(bytes / kPageBytes, 1));
  for (Pages& pages : pages_) pages.resize(count);
}

float PagedMap::at(int row, int column) const {
  const auto thread = static_cast<std::size_t>(omp_get_thread_num());
  assert(thread < pages_.size());
  Pages& pages = pages_[thread];
  const std::int64_t number = (row >> kPageBits) * across_ + (column >> kPageBits);
  Page& page = pages[hash_combine(1, static_cast<std::uint64_t>(number)) % pages.size()];
  if (page.number != number) read_page(number, page);
  constexpr int kWithin = kPageSide - 1;
  return page.samples[static_cast<std::size_t>((row & kWithin) * kPageSide + (column & kWithin))];
}

void PagedMap::read_page(std::int64_t number, Page& page) const {
  const MapRect rect{static_cast<int>(number / across_) * kPageSide,
                     static_cast<int>(number % across_) * kPageSide, 0, 0};
  const int rows = std::min(kPageSide, stored_.height() - rect.first_row);
  const int columns = std::min(kPageSide, stored_.width() - rect.first_column);
  page.number = -1;
  page.samples.resize(kPageSide * kPageSide);
  stored_.read({rect.first_row, rect.first_column, rows, columns}, page.samples.data());
  for (int i = rows - 1; i > 0; --i) {  // rows of their own length become rows of a whole page's
    float* from = page.samples.data() + std::ptrdiff_t{i} * columns;
    std::copy_backward(from, from + columns, page.samples.data() + std::ptrdiff_t{i} * kPageSide + columns);
  }
  page.number = number;
}

}  // namespace heightlight
