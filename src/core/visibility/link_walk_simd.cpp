// The lanes of the vector hold neighbouring receivers of a row. The arithmetic is link_walk_scalar.cpp's.

#include <hwy/aligned_allocator.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "visibility/link_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/link_walk_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "visibility/walk_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

/// a / b to 1e-6, for normal b: a Newton's step on the machine's estimate, good to 11 bits on x86.
HWY_INLINE VF quotient(VF a, VF b) {
  constexpr bool kIsX86 = HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128;
  VF inverse = hn::ApproximateReciprocal(b);
  for (int i = 0; i < (kIsX86 ? 1 : 2); ++i)
    inverse = hn::Mul(inverse, hn::NegMulAdd(b, inverse, hn::Set(kF, 2.0F)));
  return hn::Mul(a, inverse);
}

/// Weights of a block's receivers, node by node, all 0 but where `touched` says so.
struct BlockWeights {
  HWY_ALIGN float weight[kMostNodes][kBlock] = {};
  std::uint8_t touched[kMostNodes] = {};
};

/// The samples of an azimuth, outwards, numbered from 1 on; 0 is the receiver's own place.
struct SampleList {
  std::vector<float> way{0};
  std::vector<NodeShare> share{{}};
  std::vector<std::size_t> ring_begin;  ///< number of each ring's first

  explicit SampleList(const LinkAzimuth& azimuth) {
    for (const NearSample& sample : azimuth.walk.near) way.push_back(sample.way);
    share.insert(share.end(), azimuth.light.near.begin(), azimuth.light.near.end());
    for (std::size_t ring = 0; ring < azimuth.walk.rings.size(); ++ring) {
      ring_begin.push_back(way.size());
      for (const RingSample& sample : azimuth.walk.rings[ring]) way.push_back(sample.way);
      share.insert(share.end(), azimuth.light.rings[ring].begin(), azimuth.light.rings[ring].end());
    }
  }
};

/// What one vector of receivers sees along one azimuth. It looks at all samples first and then gives weight
/// to those that rise: in one loop, whether a sample does is what the machine would guess wrongly, and wait
/// for.
struct Sightings {
  hwy::AlignedFreeUniquePtr<float[]> slopes;  ///< under which each sample is seen, a vector each
  std::vector<std::uint32_t> rising;          ///< numbers of those that rise above all before, for any lane
  std::size_t count = 0;                      ///< of `rising`

  explicit Sightings(std::size_t samples)
      : slopes(hwy::AllocateAligned<float>(samples * hn::Lanes(kF))), rising(samples) {}

  float* slope(std::size_t sample) const { return slopes.get() + sample * hn::Lanes(kF); }
};

/// One vector of receivers: how it finds its sightings, and what weight they have.
class LinkLanes {
 public:
  LinkLanes(const WalkTile& tile, const LinkAzimuth& azimuth, const SampleList& samples, int row, int column)
      : tile_(tile),
        azimuth_(azimuth),
        samples_(samples),
        row_(tile.first_row + row),
        column_(tile.first_column + column) {
    const auto at = static_cast<std::size_t>(row * WalkTile::kSide + column);
    n_z_ = hn::Load(kF, tile.normal_z.data() + at);
    z_ = hn::Load(kF, tile.height.data() + at);
    tangent_ = hn::MulAdd(hn::Load(kF, tile.slope_x.data() + at), hn::Set(kF, azimuth.walk.world_x),
                          hn::Mul(hn::Load(kF, tile.slope_y.data() + at), hn::Set(kF, azimuth.walk.world_y)));
    c_ = hn::Neg(hn::Mul(n_z_, tangent_));
  }

  /// `highest` is of each ring's blocks.
  HWY_INLINE void look(const float* highest, Sightings& sightings) const {
    sightings.count = 0;
    hn::Store(hn::Zero(kF), kF, sightings.slope(0));
    VF slope = tangent_;
    look_near(tile_.windows[0], 0, azimuth_.walk.lifted, slope, sightings);
    look_near(tile_.lifted, azimuth_.walk.lifted, azimuth_.walk.near.size(), slope, sightings);
    for (std::size_t ring = 0; ring < azimuth_.walk.rings.size(); ++ring) {
      const float nearest = azimuth_.walk.rings[ring].front().per_distance;
      if (may_rise(highest[ring], nearest, slope)) look_at_ring(ring, slope, sightings);
    }
  }

  /// Adds what is seen to the weights, of which `weights` are those of the first receiver and node 0.
  HWY_INLINE void give(const Sightings& sightings, float* weights, std::uint8_t* touched) const {
    Horizon horizon = horizon_at(tangent_);
    for (std::size_t i = 0; i < sightings.count; ++i) {
      const std::size_t sample = sightings.rising[i];
      const VF s = hn::Load(kF, sightings.slope(sample));
      const auto rises = hn::Gt(s, hn::Add(horizon.slope, hn::Set(kF, kLeastRise)));
      const Horizon next = horizon_at(s);
      const VF weight = hn::IfThenElseZero(rises, hn::Sub(next.seen, horizon.seen));
      const NodeShare share = samples_.share[sample];
      float* node = weights + std::ptrdiff_t{share.node} * kBlock;
      touched[share.node] = 1;
      if (share.splits) {
        touched[share.node + 1] = 1;
        const VF slope_before = hn::Load(kF, sightings.slope(sample - 1));
        const VF place =
            place_seen(horizon, next, slope_before, samples_.way[sample - 1], samples_.way[sample]);
        const VF given = hn::IfThenElseZero(rises, hn::Mul(weight, place));
        hn::Store(hn::Add(hn::Load(kF, node + kBlock), given), kF, node + kBlock);
        hn::Store(hn::Add(hn::Load(kF, node), hn::Sub(weight, given)), kF, node);
      } else {
        hn::Store(hn::Add(hn::Load(kF, node), weight), kF, node);
      }
      horizon.slope = hn::IfThenElse(rises, next.slope, horizon.slope);
      horizon.cosine = hn::IfThenElse(rises, next.cosine, horizon.cosine);
      horizon.normal = hn::IfThenElse(rises, next.normal, horizon.normal);
      horizon.seen = hn::IfThenElse(rises, next.seen, horizon.seen);
    }
  }

 private:
  /// A slope, the cosines of its elevation and to the normal, and the mass of what lies below it, but for a
  /// constant.
  struct Horizon {
    VF slope, cosine, normal, seen;
  };

  HWY_INLINE Horizon horizon_at(VF slope) const {
    const Elevation<VF> at = elevation(kF, slope);
    const VF normal = hn::Max(hn::MulAdd(c_, at.cosine, hn::Mul(n_z_, at.sine)), hn::Zero(kF));
    const VF below = hn::MulSub(at.sine, at.cosine, at.from_zenith);
    const VF squared = hn::Mul(at.cosine, at.cosine);
    return {slope, at.cosine, normal, hn::NegMulAdd(n_z_, squared, hn::Mul(c_, below))};
  }

  HWY_INLINE void see(VF s, std::size_t sample, VF& slope, Sightings& sightings) const {
    hn::Store(s, kF, sightings.slope(sample));
    const auto rises = hn::Gt(s, hn::Add(slope, hn::Set(kF, kLeastRise)));
    sightings.rising[sightings.count] = static_cast<std::uint32_t>(sample);
    sightings.count += hn::AllFalse(kF, rises) ? 0 : 1;
    slope = hn::IfThenElse(rises, s, slope);
  }

  /// Near samples `first` to `end`, of one window's heights.
  HWY_INLINE void look_near(const HeightWindow& window, std::size_t first, std::size_t end, VF& slope,
                            Sightings& sightings) const {
    const float* here = window.address(row_, column_);
    for (std::size_t k = first; k < end; ++k) {
      const NearSample& sample = azimuth_.walk.near[k];
      const VF from = hn::LoadU(kF, here + sample.offset[0]);
      const VF to = hn::LoadU(kF, here + sample.offset[1]);
      const VF above =
          hn::MulAdd(hn::Set(kF, sample.weight[1]), to, hn::Mul(hn::Set(kF, sample.weight[0]), from));
      see(hn::NegMulAdd(hn::Set(kF, sample.per_distance), z_, above), k + 1, slope, sightings);
    }
  }

  HWY_INLINE void look_at_ring(std::size_t ring, VF& slope, Sightings& sightings) const {
    const HeightWindow& window = tile_.windows[ring + 1];
    const int level = window.level;
    const std::vector<RingSample>& samples = azimuth_.walk.rings[ring];
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const RingSample& sample = samples[k];
      const int start = column_ + sample.column;
      const float* first = window.values.data() +
                           std::ptrdiff_t{((row_ + sample.row) >> level) - window.first_row} * window.width +
                           ((start >> level) - window.first_column);
      const int phase = start & ((1 << level) - 1);
      const auto order =
          hn::IndicesFromVec(kF, hn::ShiftRightSame(hn::Add(hn::Set(kI, phase), hn::Iota(kI, 0)), level));
      const VF height = hn::TableLookupLanes(hn::LoadU(kF, first), order);
      see(hn::Mul(hn::Sub(height, z_), hn::Set(kF, sample.per_distance)), samples_.ring_begin[ring] + k,
          slope, sightings);
    }
  }

  /// Could a height of at most `highest`, no nearer than 1 / `per_distance`, raise any horizon?
  HWY_INLINE bool may_rise(float highest, float per_distance, VF slope) const {
    const VF above = hn::Max(hn::Sub(hn::Set(kF, highest), z_), hn::Zero(kF));
    return !hn::AllFalse(kF, hn::Gt(hn::Mul(above, hn::Set(kF, per_distance)), slope));
  }

  /// How far along the stretch between the sample before and one at `way` the mean of what comes into sight
  /// of it lies.
  HWY_INLINE VF place_seen(const Horizon& from, const Horizon& to, VF slope_before, float way_before,
                           float way) const {
    if (way_before <= 0) return hn::Set(kF, kOwnFacet);
    const VF before = hn::Set(kF, way_before);
    const VF after = hn::Set(kF, way);
    const VF below = hn::Mul(before, hn::Sub(from.slope, slope_before));
    const VF begin = quotient(below, hn::MulAdd(after, hn::Sub(to.slope, from.slope), below));
    const VF from_way = hn::MulAdd(begin, hn::Sub(after, before), before);
    return hn::MulAdd(hn::Sub(hn::Set(kF, 1.0F), begin), mean_share(from, to, from_way, after), begin);
  }

  /// Mean place of the stretch that comes into sight, as a share of it.
  HWY_INLINE VF mean_share(const Horizon& from, const Horizon& to, VF from_way, VF to_way) const {
    const VF step = hn::Sub(to.cosine, from.cosine);
    const VF normal_step = hn::Sub(to.normal, from.normal);
    const VF near_scale = hn::Mul(from_way, to.cosine);
    const VF far_scale = hn::Mul(to_way, from.cosine);
    // Both nodes' weights towards · along and shares near / reach, over one denominator.
    std::array<VF, 2> weight, near, reach;
    for (std::size_t i = 0; i < 2; ++i) {
      const VF t = hn::Set(kF, kNodes[i]);
      weight[i] = hn::Mul(hn::MulAdd(t, normal_step, from.normal), hn::MulAdd(t, step, from.cosine));
      near[i] = hn::Mul(t, near_scale);
      reach[i] = hn::MulAdd(hn::Set(kF, 1 - kNodes[i]), far_scale, near[i]);
    }
    const VF weighted =
        hn::MulAdd(hn::Mul(weight[0], reach[1]), near[0], hn::Mul(hn::Mul(weight[1], reach[0]), near[1]));
    const VF whole = hn::Mul(hn::Add(weight[0], weight[1]), hn::Mul(reach[0], reach[1]));
    const VF least = hn::Set(kF, std::numeric_limits<float>::min());
    return hn::IfThenElse(hn::Gt(whole, least), quotient(weighted, whole), hn::Set(kF, 0.5F));
  }

  const WalkTile& tile_;
  const LinkAzimuth& azimuth_;
  const SampleList& samples_;
  int row_, column_;
  VF c_, n_z_, z_, tangent_;
};

/// A block's weights so far, in steps, and the whole steps given for them.
struct StepCount {
  static constexpr std::size_t kVectors = kBlock / hn::MaxLanes(kF);
  std::array<VF, kVectors> sum;
  std::array<VI, kVectors> given;
};

/// Rounds a block's weights to steps, appends the entries that have any, and clears the weights.
void append_entries(const LinkAzimuth& azimuth, BlockWeights& weights, StepCount& count,
                    std::vector<std::uint8_t>& stream) {
  const std::size_t nodes = azimuth.light.nodes.size();
  std::uint8_t entries[2 + kMostNodes * kEntryBytes];
  entries[0] = entries[1] = 0;
  std::uint8_t* out = entries + 2;
  const hn::Rebind<std::uint8_t, F> bytes;
  StepCount so_far = count;
  for (std::size_t node = 0; node < nodes; ++node) {
    if (weights.touched[node] == 0) continue;
    weights.touched[node] = 0;
    auto any = hn::Zero(kI);
    for (std::size_t v = 0; v < StepCount::kVectors; ++v) {
      float* weight = weights.weight[node] + v * hn::MaxLanes(kF);
      so_far.sum[v] = hn::MulAdd(hn::Load(kF, weight), hn::Set(kF, kQuantum), so_far.sum[v]);
      hn::Store(hn::Zero(kF), kF, weight);
      const VI rounded = hn::Max(hn::NearestInt(so_far.sum[v]), so_far.given[v]);
      const VI steps = hn::Sub(rounded, so_far.given[v]);
      so_far.given[v] = rounded;
      hn::StoreU(hn::DemoteTo(bytes, steps), bytes, out + 1 + v * hn::MaxLanes(kF));
      any = hn::Or(any, steps);
    }
    out[0] = static_cast<std::uint8_t>(node);
    const bool has_any = !hn::AllTrue(kI, hn::Eq(any, hn::Zero(kI)));
    out += has_any ? kEntryBytes : 0;
    entries[static_cast<int>(node) < azimuth.light.near_nodes ? 0 : 1] += has_any ? 1 : 0;
  }
  count = so_far;
  stream.insert(stream.end(), entries, out);
}

void walk_links_lanes(const WalkTile& tile, const std::vector<LinkAzimuth>& azimuths, const BlockSet& blocks,
                      std::vector<std::uint8_t>& stream) {
  const int lanes = static_cast<int>(hn::Lanes(kF));
  const std::size_t rings = azimuths.empty() ? 0 : azimuths.front().walk.rings.size();
  const RingBounds bounds(tile);
  std::vector<float> highest(azimuths.size() * rings);
  std::vector<SampleList> samples;
  std::size_t most = 1;
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    for (std::size_t ring = 0; ring < rings; ++ring) {
      highest[k * rings + ring] = bounds.highest(azimuths[k].walk, static_cast<int>(ring) + 1);
    }
    samples.emplace_back(azimuths[k]);
    most = std::max(most, samples.back().way.size());
  }
  Sightings sightings(most);
  BlockWeights weights;
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += kBlock) {
      if (!blocks[block_index(row, column)]) continue;
      StepCount count;
      count.sum.fill(hn::Zero(kF));
      count.given.fill(hn::Zero(kI));
      for (std::size_t k = 0; k < azimuths.size(); ++k) {
        for (int lane = 0; lane < kBlock; lane += lanes) {
          const LinkLanes walk(tile, azimuths[k], samples[k], row, column + lane);
          walk.look(highest.data() + k * rings, sightings);
          walk.give(sightings, &weights.weight[0][lane], weights.touched);
        }
        append_entries(azimuths[k], weights, count, stream);
      }
    }
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(walk_links_lanes);

void walk_links(const WalkTile& tile, const std::vector<LinkAzimuth>& azimuths, const BlockSet& blocks,
                std::vector<std::uint8_t>& stream) {
  HWY_DYNAMIC_DISPATCH(walk_links_lanes)(tile, azimuths, blocks, stream);
}

}  // namespace heightlight
#endif
