#include <array>

#include "transport/link_replay.h"

namespace heightlight {
namespace {

float value_at(const LightLevel& level, int row, int column) {
  return level.origin()[std::ptrdiff_t{row} * level.stride() + column];
}

float look_at(const LightMips& light, const LightNode& node, int row, int column) {
  const LightLevel& level = light.level(node.level);
  if (node.level == 0) {
    const float from = value_at(level, row + node.row[0], column + node.column[0]);
    const float to = value_at(level, row + node.row[1], column + node.column[1]);
    return from + node.share * (to - from);
  }
  if (node.level >= kSharedLight) column = column / kShared * kShared + kShared / 2;
  return value_at(level, (row + node.row[0]) >> node.level, (column + node.column[0]) >> node.level);
}

}  // namespace

void replay_links_scalar(const TileFrame& tile, const std::vector<LinkAzimuth>& azimuths,
                         const BlockSet& blocks, const std::uint8_t* stream, const LightMips& light,
                         float* mean) {
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; j += kBlock) {
      if (!blocks[block_index(i, j)]) continue;
      const int row = tile.first_row + i;
      const int column = tile.first_column + j;
      std::array<float, kBlock> sum{};
      std::array<float, kBlock> weight{};
      for (const LinkAzimuth& azimuth : azimuths) {
        const int entries = stream[0] + stream[1];
        stream += 2;
        for (int entry = 0; entry < entries; ++entry, stream += kEntryBytes) {
          const LightNode& node = azimuth.light.nodes[stream[0]];
          for (int lane = 0; lane < kBlock; ++lane) {
            const auto l = static_cast<std::size_t>(lane);
            const float steps = stream[1 + lane];
            sum[l] += steps * look_at(light, node, row, column + lane);
            weight[l] += steps;
          }
        }
      }
      for (int lane = 0; lane < kBlock; ++lane) {
        const auto l = static_cast<std::size_t>(lane);
        mean[i * TileFrame::kSide + j + lane] =
            weight[l] > 0 ? sum[l] / weight[l] : value_at(light.level(0), row, column + lane);
      }
    }
  }
}

}  // namespace heightlight
