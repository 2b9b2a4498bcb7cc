// How a gather walks: included once per target, by the files that Highway compiles for each.

#if defined(HEIGHTLIGHT_GATHER_LANES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef HEIGHTLIGHT_GATHER_LANES_INL_H
#undef HEIGHTLIGHT_GATHER_LANES_INL_H
#else
#define HEIGHTLIGHT_GATHER_LANES_INL_H
#endif

#include <hwy/aligned_allocator.h>
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/elevation-inl.h"
#include "transport/gather_walk.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using GF = hn::CappedTag<float, kGatherBlock>;
using GI = hn::RebindToSigned<GF>;
using GV = hn::Vec<GF>;
constexpr GF kGF;
constexpr GI kGI;

/// Rows walked together: what is fetched for one of them serves all.
constexpr std::size_t kGatherRows = kGatherBlockRows;

/// What one vector of receivers finds along one azimuth.
struct RisingSamples {
  hwy::AlignedFreeUniquePtr<float[]> slopes;  ///< under which each sample is seen: one vector per sample
  std::vector<std::uint32_t> rising;  ///< numbers of the samples that rise above all before, in any lane
  std::size_t count = 0;

  explicit RisingSamples(std::size_t samples)
      : slopes(hwy::AllocateAligned<float>((samples + 1) * hn::Lanes(kGF))), rising(samples + 1) {}

  HWY_INLINE float* slope(std::size_t number) const { return slopes.get() + number * hn::Lanes(kGF); }
};

using RisingRows = std::array<RisingSamples, kGatherRows>;

/// Neighbouring receivers, one vector in each row, that walk along one azimuth.
class GatherLanes {
 public:
  GatherLanes(const GatherTask& task, const GatherAzimuth& azimuth, int row, int column)
      : task_(task),
        azimuth_(azimuth),
        row_(task.tile.map_row + row),
        column_(task.tile.map_column + column),
        at_(static_cast<std::size_t>(row * ReceiverTile::kSide + column)) {
    const ReceiverTile& tile = task.tile;
    for (std::size_t v = 0; v < kGatherRows; ++v) {
      const std::size_t at = at_ + v * ReceiverTile::kSide;
      height_[v] = hn::Load(kGF, tile.height.data() + at);
      slope_[v] = hn::MulAdd(hn::Load(kGF, tile.slope_x.data() + at), hn::Set(kGF, azimuth.world_x),
                             hn::Mul(hn::Load(kGF, tile.slope_y.data() + at), hn::Set(kGF, azimuth.world_y)));
      tangent_[v] = slope_[v];
    }
  }

  /// Examines all samples first; gather() then weighs those that rise. In a single loop, whether a sample
  /// rises would be a branch that the processor often mispredicts.
  HWY_INLINE void look(RisingRows& rows) {
    std::array<Looking, kGatherRows> looking;
    for (std::size_t v = 0; v < kGatherRows; ++v) looking[v] = start_looking(v, rows[v]);
    const GatherSample* samples = azimuth_.samples.data();
    const std::size_t end = azimuth_.samples.size();
    for (std::size_t first = 0; first < end; first += kAtOnce) {
      if (first > 0 && !may_rise(samples[first].per_distance, looking)) break;
      for (std::size_t number = first; number < std::min(first + kAtOnce, end); ++number) {
        const GatherSample& sample = samples[number];
        for (std::size_t v = 0; v < kGatherRows; ++v) {
          const GV slope = number < azimuth_.near ? slope_near(sample, number >= azimuth_.lifted, looking[v])
                                                  : slope_of_block(sample, v, looking[v]);
          see(slope, number, looking[v]);
        }
      }
    }
    for (std::size_t v = 0; v < kGatherRows; ++v) {
      slope_[v] = looking[v].slope;
      rows[v].count = looking[v].count;
    }
  }

  template <std::size_t kFields>
  HWY_INLINE void gather(std::size_t v, const RisingSamples& samples, GatherSums& sums) const {
    const std::size_t at = at_ + v * ReceiverTile::kSide;
    const GV n_z = hn::Load(kGF, task_.tile.normal_z.data() + at);
    const GV c = hn::Neg(hn::Mul(n_z, tangent_[v]));
    Horizon horizon = horizon_at(c, n_z, tangent_[v]);
    GV weight_sum = hn::Zero(kGF);
    std::array<GV, kFields> sum, last;
    std::array<const float*, kFields> here;
    for (std::size_t f = 0; f < kFields; ++f) {
      here[f] = address(task_.fields[f]->level(0), v);
      sum[f] = hn::Zero(kGF);
      last[f] = hn::LoadU(kGF, here[f]);
    }
    for (std::size_t i = 0; i < samples.count; ++i) {
      const std::size_t number = samples.rising[i];
      const GV s = hn::Load(kGF, samples.slope(number));
      const auto rises = hn::Gt(s, bar_above(horizon.slope));
      const Horizon next = horizon_at(c, n_z, s);
      const GV weight = hn::IfThenElseZero(rises, hn::Max(hn::Sub(next.seen, horizon.seen), hn::Zero(kGF)));
      const GV place = place_seen(horizon, next, samples, number);
      for (std::size_t f = 0; f < kFields; ++f) {
        const GV seen = number == 0 ? own_facet(here[f]) : value_between(f, v, here[f], number, place);
        sum[f] = hn::MulAdd(weight, seen, sum[f]);
        last[f] = hn::IfThenElse(rises, seen, last[f]);
      }
      weight_sum = hn::Add(weight_sum, weight);
      horizon.slope = hn::IfThenElse(rises, next.slope, horizon.slope);
      horizon.cosine = hn::IfThenElse(rises, next.cosine, horizon.cosine);
      horizon.seen = hn::IfThenElse(rises, next.seen, horizon.seen);
      horizon.towards = hn::IfThenElse(rises, next.towards, horizon.towards);
    }
    // Rises too small to be gathered by themselves belong to the last part of the surface that was seen.
    const Horizon highest = horizon_at(c, n_z, slope_[v]);
    const GV rest = hn::Max(hn::Sub(highest.seen, horizon.seen), hn::Zero(kGF));
    for (std::size_t f = 0; f < kFields; ++f)
      add_to(sums.weighted[f].data() + at, hn::MulAdd(rest, last[f], sum[f]));
    add_to(sums.weight.data() + at, hn::Add(weight_sum, rest));
  }

 private:
  static constexpr std::size_t kAtOnce = 8;

  /// A slope; the cosine of its elevation h; −S of the slope up to a constant, which grows with what lies
  /// below it (`seen`); and c cos h + n_z sin h (`towards`): `seen` grows with h by 2 cos h times that.
  struct Horizon {
    GV slope, cosine, seen, towards;
  };

  static HWY_INLINE void add_to(float* sum, GV value) {
    hn::Store(hn::Add(value, hn::Load(kGF, sum)), kGF, sum);
  }

  HWY_INLINE GV bar_above(GV m) const {
    const GV least = hn::Set(kGF, task_.walk.least_rise);
    return hn::MulAdd(hn::Abs(m), least, hn::Add(m, least));
  }

  /// −S(m) up to a constant: c (h + sin h cos h) − n_z cos²h. With a = |sin h|, acos a = cos h · R(a), where
  /// R is smooth. A polynomial approximates R to 2e-5 (Lawson's algorithm), which suffices for weights of
  /// which only the ratios count.
  static HWY_INLINE Horizon horizon_at(GV c, GV n_z, GV slope) {
    constexpr std::array<float, 6> kRatio{1.5707749F,  -0.9982547F, 0.7620501F,
                                          -0.5471174F, 0.2818592F,  -0.0693335F};
    const GV one = hn::Set(kGF, 1.0F);
    const GV size = hn::Min(hn::Abs(slope), hn::Set(kGF, 1e18F));
    const GV square = hn::MulAdd(size, size, one);
    GV cosine = hn::ApproximateReciprocalSqrt(square);
    cosine = hn::MulAdd(hn::Mul(hn::Set(kGF, 0.5F), cosine),
                        hn::NegMulAdd(hn::Mul(square, cosine), cosine, one), cosine);
    const GV sine = hn::Mul(size, cosine);
    GV ratio = hn::Set(kGF, kRatio[5]);
    for (std::size_t i = 5; i-- > 0;) ratio = hn::MulAdd(ratio, sine, hn::Set(kGF, kRatio[i]));
    const GV half_pi = hn::Set(kGF, kRatio[0]);
    // The integral from the horizontal to |h|: h + sin h cos h, odd in h.
    const GV below = hn::CopySign(hn::NegMulAdd(cosine, hn::Sub(ratio, sine), half_pi), slope);
    const GV towards = hn::MulAdd(c, cosine, hn::Mul(n_z, hn::CopySign(sine, slope)));
    return {slope, cosine, hn::NegMulAdd(n_z, hn::Mul(cosine, cosine), hn::Mul(c, below)),
            hn::Max(towards, hn::Zero(kGF))};
  }

  /// A row of receivers while it examines samples: kept outside *this, so that it stays in registers.
  struct Looking {
    GV height, slope, bar;
    const float* here;    ///< the receivers' own samples
    const float* lifted;  ///< the same in the lifted heights
    float* slopes;        ///< as in RisingSamples, like `rising` and `count`
    std::uint32_t* rising;
    std::size_t count;
  };

  HWY_INLINE Looking start_looking(std::size_t v, RisingSamples& samples) const {
    return {.height = height_[v],
            .slope = slope_[v],
            .bar = bar_above(slope_[v]),
            .here = address(task_.scene.heights.level(0), v),
            .lifted = address(task_.scene.lifted.level(0), v),
            .slopes = samples.slope(0),
            .rising = samples.rising.data(),
            .count = 0};
  }

  /// Whether a sample no nearer than 1 / `per_distance` could raise any receiver's horizon.
  HWY_INLINE bool may_rise(float per_distance, const std::array<Looking, kGatherRows>& looking) const {
    const GV highest = hn::Set(kGF, task_.highest);
    auto rises = hn::FirstN(kGF, 0);
    for (const Looking& row : looking) {
      const GV above = hn::Max(hn::Sub(highest, row.height), hn::Zero(kGF));
      rises = hn::Or(rises, hn::Gt(hn::Mul(above, hn::Set(kGF, per_distance)), row.bar));
    }
    return !hn::AllFalse(kGF, rises);
  }

  HWY_INLINE void see(GV slope, std::size_t number, Looking& row) const {
    hn::Store(slope, kGF, row.slopes + number * hn::Lanes(kGF));
    const auto rises = hn::Gt(slope, row.bar);
    row.rising[row.count] = static_cast<std::uint32_t>(number);
    row.count += hn::AllFalse(kGF, rises) ? 0 : 1;
    row.slope = hn::Max(row.slope, slope);
    row.bar = hn::IfThenElse(rises, bar_above(slope), row.bar);
  }

  static HWY_INLINE GV slope_near(const GatherSample& sample, bool lifted, const Looking& row) {
    const float* here = lifted ? row.lifted : row.here;
    const GV from = hn::Sub(hn::LoadU(kGF, here + sample.offset[0]), row.height);
    const GV to = hn::Sub(hn::LoadU(kGF, here + sample.offset[1]), row.height);
    return hn::MulAdd(hn::Set(kGF, sample.weight[1]), to, hn::Mul(hn::Set(kGF, sample.weight[0]), from));
  }

  HWY_INLINE GV slope_of_block(const GatherSample& sample, std::size_t v, const Looking& row) const {
    const GV above = hn::Sub(read_blocks(task_.scene.heights.level(sample.level), v, sample), row.height);
    return hn::Mul(above, hn::Set(kGF, sample.per_distance));
  }

  /// Address of the first receiver of row v.
  HWY_INLINE const float* address(const FieldPyramid::Level& level, std::size_t v) const {
    return level.block(row_ + static_cast<int>(v), column_);
  }

  /// The values of the blocks that neighbouring receivers of row v look at.
  HWY_INLINE GV read_blocks(const FieldPyramid::Level& blocks, std::size_t v,
                            const GatherSample& sample) const {
    const int level = sample.level;
    const int row = row_ + static_cast<int>(v) + sample.row;
    const int start = column_ + sample.column;
    const int phase = start & ((1 << level) - 1);
    const auto order =
        hn::IndicesFromVec(kGF, hn::ShiftRightSame(hn::Add(hn::Set(kGI, phase), hn::Iota(kGI, 0)), level));
    return hn::TableLookupLanes(hn::LoadU(kGF, blocks.block(row >> level, start >> level)), order);
  }

  /// Value of a field at a sample, for row v of receivers, whose own samples of the field are `here`.
  HWY_INLINE GV value_at(std::size_t field, std::size_t v, const float* here, std::size_t number) const {
    const GatherSample& sample = azimuth_.samples[number];
    if (number >= azimuth_.near) return read_blocks(task_.fields[field]->level(sample.level), v, sample);
    const GV from = hn::LoadU(kGF, here + sample.offset[0]);
    const GV to = hn::LoadU(kGF, here + sample.offset[1]);
    return hn::MulAdd(hn::Set(kGF, sample.share), hn::Sub(to, from), from);
  }

  HWY_INLINE GV value_between(std::size_t field, std::size_t v, const float* here, std::size_t number,
                              GV place) const {
    const GV begin = value_at(field, v, here, number - 1);
    return hn::MulAdd(place, hn::Sub(value_at(field, v, here, number), begin), begin);
  }

  /// Mean of the field over the triangle that has the receiver as a corner: its middle stands for what is
  /// seen of it, as it does for rays (ray_traversal.h). The first sample lies on the opposite side.
  HWY_INLINE GV own_facet(const float* here) const {
    const GatherSample& sample = azimuth_.samples[0];
    const GV own = hn::LoadU(kGF, here);
    const GV others =
        hn::Add(hn::LoadU(kGF, here + sample.offset[0]), hn::LoadU(kGF, here + sample.offset[1]));
    return hn::Mul(hn::Set(kGF, 1.0F / 3), hn::Add(own, others));
  }

  static HWY_INLINE GV quotient(GV a, GV b) {
    return hn::Mul(a, hn::ApproximateReciprocal(hn::Max(b, hn::Set(kGF, 1e-30F))));
  }

  /// Middle of what comes into sight on the stretch between the sample before and this one, as a share of the
  /// stretch.
  HWY_INLINE GV place_seen(const Horizon& from, const Horizon& to, const RisingSamples& samples,
                           std::size_t number) const {
    if (number == 0) return hn::Set(kGF, 1.0F);
    const float way_before = azimuth_.samples[number - 1].way;
    const float way = azimuth_.samples[number].way;
    const GV one = hn::Set(kGF, 1.0F);
    const GV after = hn::Set(kGF, way);
    const GV lower = hn::Sub(from.slope, hn::Load(kGF, samples.slope(number - 1)));
    const GV below = hn::Max(hn::Mul(hn::Set(kGF, way_before), lower), hn::Zero(kGF));
    const GV begin = quotient(below, hn::MulAdd(after, hn::Sub(to.slope, from.slope), below));
    const GV from_way = hn::MulAdd(begin, hn::Set(kGF, way - way_before), hn::Set(kGF, way_before));
    const GV share = mean_share(from, to, from_way, after);
    return hn::Min(hn::MulAdd(hn::Sub(one, begin), share, begin), one);
  }

  /// Mean place of the part of the stretch that comes into sight, as a share of that part. slice_integrals.h
  /// derives the mean over the chord between the directions to its ends. Here two Gauss–Legendre nodes in the
  /// angle δ between the directions suffice. The node at the share f of δ lies at t = sin fδ / (sin fδ + sin
  /// (1 − f)δ) of the chord, which a cubic in 1 − cos δ approximates to within .001 up to 120°; 1/|v|⁴ is the
  /// same at both nodes.
  static HWY_INLINE GV mean_share(const Horizon& from, const Horizon& to, GV from_way, GV to_way) {
    const GV one = hn::Set(kGF, 1.0F);
    const GV sines = hn::Mul(hn::Mul(from.slope, from.cosine), hn::Mul(to.slope, to.cosine));
    const GV cosine_between = hn::MulAdd(from.cosine, to.cosine, sines);
    const GV x = hn::Sub(one, cosine_between);
    const GV rise =
        hn::MulAdd(hn::MulAdd(hn::Set(kGF, 0.0128F), x, hn::Set(kGF, -0.004F)), x, hn::Set(kGF, 0.036F));
    const GV first = hn::MulAdd(rise, x, hn::Set(kGF, 0.21132487F));
    const std::array<GV, 2> node{first, hn::Sub(one, first)};
    const GV step = hn::Sub(to.cosine, from.cosine);
    const GV towards_step = hn::Sub(to.towards, from.towards);
    const GV near_scale = hn::Mul(from_way, to.cosine);
    const GV far_scale = hn::Mul(to_way, from.cosine);
    // Both nodes' weights towards · along and shares near / farther, over one denominator.
    std::array<GV, 2> weight, near, farther;
    for (std::size_t i = 0; i < 2; ++i) {
      weight[i] =
          hn::Mul(hn::MulAdd(node[i], towards_step, from.towards), hn::MulAdd(node[i], step, from.cosine));
      near[i] = hn::Mul(node[i], near_scale);
      farther[i] = hn::MulAdd(node[1 - i], far_scale, near[i]);
    }
    const GV weighted =
        hn::MulAdd(hn::Mul(weight[0], farther[1]), near[0], hn::Mul(hn::Mul(weight[1], farther[0]), near[1]));
    const GV whole = hn::Mul(hn::Add(weight[0], weight[1]), hn::Mul(farther[0], farther[1]));
    return hn::IfThenElse(hn::Gt(whole, hn::Set(kGF, 1e-30F)), quotient(weighted, whole), hn::Set(kGF, 0.5F));
  }

  const GatherTask& task_;
  const GatherAzimuth& azimuth_;
  int row_, column_;
  std::size_t at_;
  std::array<GV, kGatherRows> height_, tangent_, slope_;
};

/// Turns the sums of one vector of receivers in each row into means over the azimuths.
template <std::size_t kFields>
HWY_INLINE void divide(float azimuths, int row, int column, GatherSums& sums) {
  const GV share = hn::Set(kGF, 1 / azimuths);
  for (std::size_t v = 0; v < kGatherRows; ++v) {
    const std::size_t at =
        (static_cast<std::size_t>(row) + v) * ReceiverTile::kSide + static_cast<std::size_t>(column);
    const auto scale = [&](float* sum) HWY_ATTR { hn::Store(hn::Mul(share, hn::Load(kGF, sum)), kGF, sum); };
    scale(sums.weight.data() + at);
    for (std::size_t f = 0; f < kFields; ++f) scale(sums.weighted[f].data() + at);
  }
}

template <std::size_t kFields>
void gather_fields(const GatherTask& task, GatherSums& sums) {
  std::size_t most = 0;
  for (const GatherAzimuth& azimuth : task.walk.azimuths) most = std::max(most, azimuth.samples.size());
  RisingRows rows{RisingSamples(most), RisingSamples(most)};
  sums.weight.fill(0);
  for (std::size_t f = 0; f < kFields; ++f) sums.weighted[f].fill(0);
  for (int row = 0; row < task.tile.rows; row += static_cast<int>(kGatherRows)) {
    for (int column = 0; column < task.tile.columns; column += static_cast<int>(hn::Lanes(kGF))) {
      const std::size_t azimuths = task.azimuths[gather_block(row, column)];
      for (std::size_t k = 0; k < azimuths; ++k) {
        GatherLanes walk(task, task.walk.azimuths[k], row, column);
        walk.look(rows);
        for (std::size_t v = 0; v < kGatherRows; ++v) walk.gather<kFields>(v, rows[v], sums);
      }
      if (azimuths > 1) divide<kFields>(static_cast<float>(azimuths), row, column, sums);
    }
  }
}

inline void gather_tile(const GatherTask& task, GatherSums& sums) {
  switch (task.field_count) {
    case 1:
      return gather_fields<1>(task, sums);
    case 2:
      return gather_fields<2>(task, sums);
    case 3:
      return gather_fields<3>(task, sums);
    default:
      return gather_fields<4>(task, sums);
  }
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
