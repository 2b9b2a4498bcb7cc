#pragma once

#include <cstdint>
#include <vector>

#include "files/image_file.h"
#include "heightlight/image.h"

namespace heightlight {

/// A map as a page shows it: in cells of `side` × `side` texels, cut at the right and lower edges.
struct Preview {
  int width = 0;  ///< of the map, in texels
  int height = 0;
  int side = 1;
  bool picked = false;             ///< a cell is its upper left texel, not the mean of all
  std::vector<Map> channels = {};  ///< of cells; NaN where all samples are missing
};

/// No side has more cells.
constexpr int kLargestPreview = 2048;

/// Means over the smallest cells that keep to `largest` a side. `rows` fills samples with channels
/// interleaved; NaN is a missing sample, and in no mean.
Preview make_preview(int width, int height, int channels, const FillRows& rows,
                     int largest = kLargestPreview);

/// The same of maps of one size, a channel each; at least one.
Preview make_preview(const std::vector<const Map*>& maps, int largest = kLargestPreview);

/// The same of a map's channels.
Preview preview_of_channels(const std::vector<Map>& maps, int largest = kLargestPreview);

/// Of a map that was thinned out to every `side`-th texel of every `side`-th row.
Preview picked_preview(const Map& thin, int width, int height, int side);

/// Cells of so many times the side: means of the cells' own values, or the first of them where cells are
/// picked.
Preview coarsen(const Preview& preview, int times);

/// Bytes that so many channels of a map of that size hold as previews, all maps of a page together, with what
/// writing the page takes.
std::uint64_t page_bytes(int width, int height, std::uint64_t channels);

}  // namespace heightlight
