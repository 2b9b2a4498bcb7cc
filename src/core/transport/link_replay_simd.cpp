// The lanes of the vector hold neighbouring receivers of a row. The arithmetic is link_replay_scalar.cpp's.

#include <array>
#include <cstddef>
#include <cstdint>

#include "transport/link_replay.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transport/link_replay_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kShared>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
constexpr F kF;
constexpr I kI;
constexpr std::size_t kVectors = kBlock / hn::MaxLanes(kF);

struct BlockSums {
  std::array<VF, kVectors> sum, weight;

  HWY_INLINE void add(std::size_t v, const std::uint8_t* steps, VF value) {
    const hn::Rebind<std::uint8_t, F> bytes;
    const VF w = hn::ConvertTo(kF, hn::PromoteTo(kI, hn::LoadU(bytes, steps + v * hn::Lanes(kF))));
    sum[v] = hn::MulAdd(w, value, sum[v]);
    weight[v] = hn::Add(weight[v], w);
  }
};

/// Which of the blocks from the first on each receiver reads: at levels where neighbours have blocks of their
/// own, the receivers' places in them; at higher ones all read the first.
struct ReadingOrders {
  HWY_ALIGN std::int32_t order[kSharedLight + 1][1 << (kSharedLight - 1)][kShared];

  ReadingOrders() {
    for (int level = 1; level <= kSharedLight; ++level) {
      for (int phase = 0; phase < 1 << (kSharedLight - 1); ++phase) {
        for (int lane = 0; lane < kShared; ++lane) {
          order[level][phase][lane] = level == kSharedLight ? 0 : (phase + lane) >> level;
        }
      }
    }
  }
};

void replay_links_lanes(const TileFrame& tile, const std::vector<LinkAzimuth>& azimuths,
                        const BlockSet& blocks, const std::uint8_t* stream, const LightMips& light,
                        float* mean) {
  static const ReadingOrders orders;
  const LightLevel& finest = light.level(0);
  for (int i = 0; i < tile.rows; ++i) {
    for (int j = 0; j < tile.columns; j += kBlock) {
      if (!blocks[block_index(i, j)]) continue;
      const int row = tile.first_row + i;
      const int column = tile.first_column + j;
      const float* here = finest.origin() + std::ptrdiff_t{row} * finest.stride() + column;
      BlockSums sums;
      sums.sum.fill(hn::Zero(kF));
      sums.weight.fill(hn::Zero(kF));
      for (const LinkAzimuth& azimuth : azimuths) {
        const LightNode* nodes = azimuth.light.nodes.data();
        const std::uint8_t* near_end = stream + 2 + std::ptrdiff_t{stream[0]} * kEntryBytes;
        const std::uint8_t* far_end = near_end + std::ptrdiff_t{stream[1]} * kEntryBytes;
        for (stream += 2; stream != near_end; stream += kEntryBytes) {
          const LightNode& node = nodes[stream[0]];
          const float* from = here + std::ptrdiff_t{node.row[0]} * finest.stride() + node.column[0];
          const float* to = here + std::ptrdiff_t{node.row[1]} * finest.stride() + node.column[1];
          const VF share = hn::Set(kF, node.share);
          for (std::size_t v = 0; v < kVectors; ++v) {
            const std::size_t lane = v * hn::Lanes(kF);
            const VF first = hn::LoadU(kF, from + lane);
            sums.add(v, stream + 1, hn::MulAdd(share, hn::Sub(hn::LoadU(kF, to + lane), first), first));
          }
        }
        for (; stream != far_end; stream += kEntryBytes) {
          const LightNode& node = nodes[stream[0]];
          const LightLevel& level = light.level(node.level);
          const bool shared = node.level >= kSharedLight;
          const int start = column + node.column[0] + (shared ? kShared / 2 : 0);
          const float* line =
              level.origin() + std::ptrdiff_t{(row + node.row[0]) >> node.level} * level.stride();
          const std::int32_t* order = shared ? orders.order[kSharedLight][0]
                                             : orders.order[node.level][start & ((1 << node.level) - 1)];
          for (std::size_t v = 0; v < kVectors; ++v) {
            const int lane = static_cast<int>(v * hn::Lanes(kF));
            const int from = shared ? lane / kShared * kShared : lane;
            const auto indices = hn::SetTableIndices(kF, order);
            sums.add(v, stream + 1,
                     hn::TableLookupLanes(hn::LoadU(kF, line + ((start + from) >> node.level)), indices));
          }
        }
      }
      for (std::size_t v = 0; v < kVectors; ++v) {
        const std::size_t lane = v * hn::Lanes(kF);
        const VF seen = hn::Div(sums.sum[v], hn::Max(sums.weight[v], hn::Set(kF, 1.0F)));
        const auto blind = hn::Eq(sums.weight[v], hn::Zero(kF));
        hn::StoreU(hn::IfThenElse(blind, hn::LoadU(kF, here + lane), seen), kF,
                   mean + std::ptrdiff_t{i} * TileFrame::kSide + j + lane);
      }
    }
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(replay_links_lanes);

void replay_links(const TileFrame& tile, const std::vector<LinkAzimuth>& azimuths, const BlockSet& blocks,
                  const std::uint8_t* stream, const LightMips& light, float* mean) {
  HWY_DYNAMIC_DISPATCH(replay_links_lanes)(tile, azimuths, blocks, stream, light, mean);
}

}  // namespace heightlight
#endif
