#include "report/preview.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

int cells_of(int texels, int side) { return (texels + side - 1) / side; }

/// Means of cells as rows of samples come in.
class CellMeans {
 public:
  CellMeans(int width, int side)
      : width_(width),
        side_(side),
        sums_(static_cast<std::size_t>(cells_of(width, side))),
        counts_(sums_.size()) {}

  void add(const float* samples, int stride) {
    for (int column = 0; column < width_; ++column) {
      const float value = samples[static_cast<std::ptrdiff_t>(column) * stride];
      if (std::isnan(value)) continue;
      const auto cell = static_cast<std::size_t>(column / side_);
      sums_[cell] += static_cast<double>(value);
      ++counts_[cell];
    }
  }

  /// Writes the means of what came in, and begins anew.
  void finish(float* cells) {
    for (std::size_t i = 0; i < sums_.size(); ++i)
      cells[i] = counts_[i] > 0 ? static_cast<float>(sums_[i] / counts_[i]) : kMissing;
    std::fill(sums_.begin(), sums_.end(), 0.0);
    std::fill(counts_.begin(), counts_.end(), 0);
  }

 private:
  int width_;
  int side_;
  std::vector<double> sums_;
  std::vector<int> counts_;
};

Map pick(const Map& map, int times) {
  Map picked(cells_of(map.width, times), cells_of(map.height, times));
  for (int row = 0; row < picked.height; ++row) {
    for (int column = 0; column < picked.width; ++column)
      picked(row, column) = map(row * times, column * times);
  }
  return picked;
}

/// Means over `side` × `side` samples of every channel.
std::vector<Map> find_means(int width, int height, int channels, int side, const FillRows& rows) {
  std::vector<Map> cells(static_cast<std::size_t>(channels),
                         Map(cells_of(width, side), cells_of(height, side)));
  std::vector<CellMeans> means(cells.size(), CellMeans(width, side));
  constexpr int kStrip = 16;  // rows that are asked for at once
  const std::size_t row_size = static_cast<std::size_t>(width) * cells.size();
  std::vector<float> samples(row_size * kStrip);
  for (int row = 0; row < height; ++row) {
    if (row % kStrip == 0) rows(row, std::min(kStrip, height - row), samples.data());
    const float* const begin = samples.data() + row_size * static_cast<std::size_t>(row % kStrip);
    const bool ends = row % side == side - 1 || row == height - 1;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      means[c].add(begin + c, channels);
      if (ends) means[c].finish(&cells[c](row / side, 0));
    }
  }
  return cells;
}

/// Maps of one size, channels interleaved.
FillRows rows_of(const std::vector<const Map*>& maps) {
  return [maps](int first, int count, float* samples) {
    const std::size_t begin = maps.front()->index(first, 0);
    for (std::size_t i = begin; i < maps.front()->index(first + count, 0); ++i) {
      for (const Map* map : maps) *samples++ = map->values[i];
    }
  };
}

}  // namespace

Preview make_preview(int width, int height, int channels, const FillRows& rows, int largest) {
  assert(width > 0 && height > 0 && channels > 0 && largest > 0);
  const int side = cells_of(std::max(width, height), largest);
  return {.width = width,
          .height = height,
          .side = side,
          .channels = find_means(width, height, channels, side, rows)};
}

Preview make_preview(const std::vector<const Map*>& maps, int largest) {
  assert(!maps.empty());
  return make_preview(maps.front()->width, maps.front()->height, static_cast<int>(maps.size()), rows_of(maps),
                      largest);
}

Preview preview_of_channels(const std::vector<Map>& maps, int largest) {
  std::vector<const Map*> pointers;
  for (const Map& map : maps) pointers.push_back(&map);
  return make_preview(pointers, largest);
}

Preview picked_preview(const Map& thin, int width, int height, int side) {
  assert(thin.width == cells_of(width, side) && thin.height == cells_of(height, side));
  return {.width = width, .height = height, .side = side, .picked = true, .channels = {thin}};
}

Preview coarsen(const Preview& preview, int times) {
  assert(times > 0);
  Preview coarse = preview;
  coarse.side *= times;
  for (Map& channel : coarse.channels) {
    channel = preview.picked
                  ? pick(channel, times)
                  : find_means(channel.width, channel.height, 1, times, rows_of({&channel})).front();
  }
  return coarse;
}

std::uint64_t page_bytes(int width, int height, std::uint64_t channels) {
  const int side = cells_of(std::max(width, height), kLargestPreview);
  const auto cells =
      static_cast<std::uint64_t>(cells_of(width, side)) * static_cast<std::uint64_t>(cells_of(height, side));
  constexpr std::uint64_t kPage = 40 << 20;  // the page four times over
  constexpr std::uint64_t kPacking = 8;      // per cell: levels, their bytes, these deflated and as text
  return kPage + cells * (channels * sizeof(float) + kPacking);
}

}  // namespace heightlight
