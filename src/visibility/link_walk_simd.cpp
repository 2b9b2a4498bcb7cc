// The lanes of the vector hold neighbouring receivers of a row. The arithmetic is link_walk_scalar.cpp's.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "visibility/link_walk.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/link_walk_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "visibility/walk_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

/// Weights of a block's receivers, node by node, all 0 but where `touched` says so.
struct BlockWeights {
  HWY_ALIGN float weight[kMostNodes][kBlock] = {};
  std::uint8_t touched[kMostNodes] = {};
};

/// One vector of receivers on its walk along one azimuth.
class LinkLanes {
 public:
  LinkLanes(const WalkTile& tile, const LinkAzimuth& azimuth, int row, int column, BlockWeights& weights,
            int lane)
      : tile_(tile),
        azimuth_(azimuth),
        row_(tile.first_row + row),
        column_(tile.first_column + column),
        weights_(&weights.weight[0][lane]),
        touched_(weights.touched) {
    const auto at = static_cast<std::size_t>(row * WalkTile::kSide + column);
    n_z_ = hn::Load(kF, tile.normal_z.data() + at);
    z_ = hn::Load(kF, tile.height.data() + at);
    slope_ = hn::MulAdd(hn::Load(kF, tile.slope_x.data() + at), hn::Set(kF, azimuth.walk.world_x),
                        hn::Mul(hn::Load(kF, tile.slope_y.data() + at), hn::Set(kF, azimuth.walk.world_y)));
    c_ = hn::Neg(hn::Mul(n_z_, slope_));
    const Elevation<VF> horizon = elevation(kF, slope_);
    cosine_ = horizon.cosine;
    seen_ = mass(horizon);
    slope_before_ = hn::Zero(kF);
  }

  void walk_near() {
    walk_near_of(tile_.windows[0], 0, azimuth_.walk.lifted);
    walk_near_of(tile_.lifted, azimuth_.walk.lifted, azimuth_.walk.near.size());
  }

  /// Near samples `first` to `end`, of one window's heights.
  void walk_near_of(const HeightWindow& window, std::size_t first, std::size_t end) {
    const float* here = window.place(row_, column_);
    for (std::size_t k = first; k < end; ++k) {
      const NearSample& sample = azimuth_.walk.near[k];
      const float* from = here + sample.offset[0];
      const float* to = here + sample.offset[1];
      const VF above = hn::MulAdd(hn::Set(kF, sample.weight[1]), hn::LoadU(kF, to),
                                  hn::Mul(hn::Set(kF, sample.weight[0]), hn::LoadU(kF, from)));
      look(hn::NegMulAdd(hn::Set(kF, sample.per_distance), z_, above), sample.way, azimuth_.light.near[k]);
    }
  }

  void walk_ring(int ring) {
    const HeightWindow& window = tile_.windows[static_cast<std::size_t>(ring)];
    const int level = window.level;
    const std::vector<RingSample>& samples = azimuth_.walk.rings[static_cast<std::size_t>(ring) - 1];
    const std::vector<NodeShare>& shares = azimuth_.light.rings[static_cast<std::size_t>(ring) - 1];
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
      look(hn::Mul(hn::Sub(height, z_), hn::Set(kF, sample.per_distance)), sample.way, shares[k]);
    }
  }

  /// Could a height of at most `highest`, no nearer than 1 / `per_distance`, raise any horizon?
  bool may_rise(float highest, float per_distance) const {
    const VF above = hn::Max(hn::Sub(hn::Set(kF, highest), z_), hn::Zero(kF));
    return !hn::AllFalse(kF, hn::Gt(hn::Mul(above, hn::Set(kF, per_distance)), slope_));
  }

 private:
  /// Of what lies below a horizon, but for a constant.
  VF mass(const Elevation<VF>& horizon) const {
    const VF q = hn::Mul(horizon.cosine, horizon.cosine);
    const VF below = hn::MulSub(horizon.sine, horizon.cosine, horizon.from_zenith);
    return hn::NegMulAdd(n_z_, q, hn::Mul(c_, below));
  }

  void look(VF s, float way, const NodeShare& share) {
    const auto rises = hn::Gt(s, hn::Add(slope_, hn::Set(kF, kLeastRise)));
    if (!hn::AllFalse(kF, rises)) give(s, rises, way, share);
    slope_before_ = s;
    way_before_ = way;
  }

  /// Mean place of the visible stretch, as a share of it.
  VF mean_share(VF to_slope, VF to_cosine, VF from_way, VF to_way) const {
    const VF zero = hn::Zero(kF);
    const VF from_sine = hn::Mul(slope_, cosine_);
    const VF to_sine = hn::Mul(to_slope, to_cosine);
    const VF from_normal = hn::Max(hn::MulAdd(c_, cosine_, hn::Mul(n_z_, from_sine)), zero);
    const VF to_normal = hn::Max(hn::MulAdd(c_, to_cosine, hn::Mul(n_z_, to_sine)), zero);
    const VF near_scale = hn::Mul(from_way, to_cosine);
    const VF far_scale = hn::Mul(to_way, cosine_);
    // Both nodes' weights towards · along / squared² and shares near / (near + far), over one denominator.
    std::array<VF, 2> weight, near, reach, squares;
    for (std::size_t i = 0; i < 2; ++i) {
      const VF t = hn::Set(kF, kNodes[i]);
      const VF along = hn::MulAdd(t, hn::Sub(to_cosine, cosine_), cosine_);
      const VF up = hn::MulAdd(t, hn::Sub(to_sine, from_sine), from_sine);
      const VF squared = hn::MulAdd(along, along, hn::Mul(up, up));
      squares[i] = hn::Mul(squared, squared);
      weight[i] = hn::Mul(hn::MulAdd(t, hn::Sub(to_normal, from_normal), from_normal), along);
      near[i] = hn::Mul(t, near_scale);
      reach[i] = hn::MulAdd(hn::Set(kF, 1 - kNodes[i]), far_scale, near[i]);
    }
    const VF first = hn::Mul(weight[0], squares[1]);
    const VF second = hn::Mul(weight[1], squares[0]);
    const VF weighted =
        hn::MulAdd(hn::Mul(first, near[0]), reach[1], hn::Mul(hn::Mul(second, near[1]), reach[0]));
    const VF whole = hn::Mul(hn::Add(first, second), hn::Mul(reach[0], reach[1]));
    return hn::IfThenElse(hn::Gt(whole, zero), hn::Div(weighted, whole), hn::Set(kF, 0.5F));
  }

  void give(VF s, hn::Mask<F> rises, float way, const NodeShare& share) {
    const VF one = hn::Set(kF, 1.0F);
    const Elevation<VF> horizon = elevation(kF, s);
    const VF mass_above = mass(horizon);
    const VF to_cosine = horizon.cosine;
    const VF weight = hn::IfThenElseZero(rises, hn::Sub(mass_above, seen_));
    float* node = weights_ + std::ptrdiff_t{share.node} * kBlock;
    touched_[share.node] = 1;
    if (share.splits) {
      touched_[share.node + 1] = 1;
      VF next = hn::Set(kF, kOwnFacet);
      if (way_before_ > 0) {
        const VF before = hn::Set(kF, way_before_);
        const VF after = hn::Set(kF, way);
        const VF below = hn::Mul(before, hn::Sub(slope_, slope_before_));
        const VF above = hn::Mul(after, hn::Sub(s, slope_));
        const VF begin = hn::Div(below, hn::Add(below, above));
        const VF from_way = hn::MulAdd(begin, hn::Sub(after, before), before);
        next = hn::MulAdd(hn::Sub(one, begin), mean_share(s, to_cosine, from_way, after), begin);
      }
      const VF given = hn::IfThenElseZero(rises, hn::Mul(weight, next));
      hn::Store(hn::Add(hn::Load(kF, node + kBlock), given), kF, node + kBlock);
      hn::Store(hn::Add(hn::Load(kF, node), hn::Sub(weight, given)), kF, node);
    } else {
      hn::Store(hn::Add(hn::Load(kF, node), weight), kF, node);
    }
    slope_ = hn::IfThenElse(rises, s, slope_);
    cosine_ = hn::IfThenElse(rises, to_cosine, cosine_);
    seen_ = hn::IfThenElse(rises, mass_above, seen_);
  }

  const WalkTile& tile_;
  const LinkAzimuth& azimuth_;
  int row_, column_;
  float* weights_;  ///< of the vector's first receiver and node 0
  std::uint8_t* touched_;
  VF c_, n_z_, z_, slope_, cosine_, seen_, slope_before_;
  float way_before_ = 0;
};

/// Rounds a block's weights to steps, appends the entries that have any, and clears the weights.
void append_entries(const LinkAzimuth& azimuth, BlockWeights& weights, float* carry,
                    std::vector<std::uint8_t>& stream) {
  const std::size_t nodes = azimuth.light.nodes.size();
  std::uint8_t entries[2 + kMostNodes * kEntryBytes];
  entries[0] = entries[1] = 0;
  std::uint8_t* out = entries + 2;
  const hn::Rebind<std::uint8_t, F> bytes;
  for (std::size_t node = 0; node < nodes; ++node) {
    if (weights.touched[node] == 0) continue;
    weights.touched[node] = 0;
    auto any = hn::Zero(kI);
    for (std::size_t lane = 0; lane < kBlock; lane += hn::Lanes(kF)) {
      const VF weight = hn::MulAdd(hn::Load(kF, weights.weight[node] + lane), hn::Set(kF, kQuantum),
                                   hn::Load(kF, carry + lane));
      hn::Store(hn::Zero(kF), kF, weights.weight[node] + lane);
      const VI steps = hn::Min(hn::Max(hn::NearestInt(weight), hn::Zero(kI)), hn::Set(kI, 255));
      hn::Store(hn::Sub(weight, hn::ConvertTo(kF, steps)), kF, carry + lane);
      hn::StoreU(hn::DemoteTo(bytes, steps), bytes, out + 1 + lane);
      any = hn::Or(any, steps);
    }
    if (hn::AllTrue(kI, hn::Eq(any, hn::Zero(kI)))) continue;
    out[0] = static_cast<std::uint8_t>(node);
    out += kEntryBytes;
    ++entries[static_cast<int>(node) < azimuth.light.near_nodes ? 0 : 1];
  }
  stream.insert(stream.end(), entries, out);
}

void walk_links_lanes(const WalkTile& tile, const std::vector<LinkAzimuth>& azimuths,
                      std::vector<std::uint8_t>& stream) {
  const int lanes = static_cast<int>(hn::Lanes(kF));
  const std::size_t rings = azimuths.empty() ? 0 : azimuths.front().walk.rings.size();
  const RingBounds bounds(tile);
  std::vector<float> highest(azimuths.size() * rings);
  for (std::size_t k = 0; k < azimuths.size(); ++k) {
    for (std::size_t ring = 0; ring < rings; ++ring) {
      highest[k * rings + ring] = bounds.highest(azimuths[k].walk, static_cast<int>(ring) + 1);
    }
  }
  BlockWeights weights;
  for (int row = 0; row < tile.rows; ++row) {
    for (int column = 0; column < tile.columns; column += kBlock) {
      HWY_ALIGN std::array<float, kBlock> carry{};
      for (std::size_t k = 0; k < azimuths.size(); ++k) {
        const LinkAzimuth& azimuth = azimuths[k];
        for (int lane = 0; lane < kBlock; lane += lanes) {
          LinkLanes walk(tile, azimuth, row, column + lane, weights, lane);
          walk.walk_near();
          for (std::size_t ring = 0; ring < rings; ++ring) {
            const float nearest = azimuth.walk.rings[ring].front().per_distance;
            if (walk.may_rise(highest[k * rings + ring], nearest)) walk.walk_ring(static_cast<int>(ring) + 1);
          }
        }
        append_entries(azimuth, weights, carry.data(), stream);
      }
    }
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(walk_links_lanes);

void walk_links(const WalkTile& tile, const std::vector<LinkAzimuth>& azimuths,
                std::vector<std::uint8_t>& stream) {
  HWY_DYNAMIC_DISPATCH(walk_links_lanes)(tile, azimuths, stream);
}

}  // namespace heightlight
#endif
