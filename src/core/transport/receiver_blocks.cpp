#include "transport/receiver_blocks.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace heightlight {

double surface_share(const Surface& surface, const TexelVector& sky, int row, int column) {
  const int first = column / kBlock * kBlock;
  const int end = std::min(first + kBlock, surface.width());
  double squares = 0;
  int present = 0;
  for (int at = first; at < end; ++at) {
    if (std::isnan(surface.map.height(row, at))) continue;
    const double share = 1 - sky[surface.map.height.index(row, at)];
    squares += share * share;
    ++present;
  }
  return present > 0 ? std::sqrt(squares / present) : 0;
}

BlockSet blocks_above(const Surface& surface, const TexelVector& sky, const TileFrame& tile, double least) {
  BlockSet blocks;
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += kBlock) {
      const double share = surface_share(surface, sky, tile.first_row + row, tile.first_column + column);
      if (share >= least) blocks.set(block_index(row, column));
    }
  }
  return blocks;
}

std::vector<BlockSet> blocks_above(const Surface& surface, const TexelVector& sky, double least) {
  const TileGrid tiles(surface.width(), surface.height());
  std::vector<BlockSet> blocks(static_cast<std::size_t>(tiles.count()));
  parallel_for(tiles.count(), [&](std::int64_t i) {
    blocks[static_cast<std::size_t>(i)] = blocks_above(surface, sky, tiles.frame(i), least);
  });
  return blocks;
}

std::vector<BlockSet> all_blocks(const Surface& surface) {
  const TileGrid tiles(surface.width(), surface.height());
  std::vector<BlockSet> blocks;
  for (std::int64_t i = 0; i < tiles.count(); ++i) blocks.push_back(all_blocks(tiles.frame(i)));
  return blocks;
}

double block_share(const Surface& surface, const std::vector<BlockSet>& blocks) {
  double count = 0;
  for (const BlockSet& set : blocks) count += static_cast<double>(set.count());
  const int across = (surface.width() + kBlock - 1) / kBlock;
  return count / (static_cast<double>(surface.height()) * across);
}

}  // namespace heightlight
