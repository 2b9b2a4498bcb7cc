// The lanes of the vector hold rays; each iteration moves every lane by one block of the pyramid. The
// arithmetic is the same as in ray_traversal_scalar.cpp, operation for operation and without fused
// multiply-add, so that results are the same.

#include <algorithm>
#include <cstddef>
#include <iterator>

#include "visibility/ray_traversal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/ray_traversal_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::ScalableTag<float>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using MF = hn::Mask<F>;
using MI = hn::Mask<I>;

constexpr F kF;
constexpr I kI;
constexpr int kMostLanes = HWY_MAX_BYTES / sizeof(float);

// Looking into cells and refilling lanes cost more than a step, and as much for one lane as for all. Lanes
// therefore wait until this many need it: this gives a fifth more rays per second on 8 lanes. (Moving two
// groups of lanes in turn, to hide latency, gained nothing: the number of instructions is the limit.)
constexpr std::size_t kCellsDue = 3;
constexpr std::size_t kRefillsDue = 2;

MF to_float(MI mask) { return hn::RebindMask(kF, mask); }
MI to_int(MF mask) { return hn::RebindMask(kI, mask); }
VI set_int(int value) { return hn::Set(kI, value); }
VF clamp_unit(VF value) { return hn::Min(hn::Max(value, hn::Zero(kF)), hn::Set(kF, 1.0F)); }

VF away_from_zero(VF step) {
  const VF least = hn::Set(kF, kLeastStep);
  return hn::IfThenElse(hn::Lt(hn::Abs(step), least), hn::CopySign(least, step), step);
}

struct Cells {
  VF upper_left, upper_right, lower_left, lower_right;

  VF height_at(VF across, VF down) const {
    const VF upper = hn::Add(hn::Add(upper_left, hn::Mul(across, hn::Sub(upper_right, upper_left))),
                             hn::Mul(down, hn::Sub(lower_right, upper_right)));
    const VF lower = hn::Add(hn::Add(upper_left, hn::Mul(down, hn::Sub(lower_left, upper_left))),
                             hn::Mul(across, hn::Sub(lower_right, lower_left)));
    return hn::IfThenElse(hn::Ge(across, down), upper, lower);
  }
};

struct Lanes {
  const RayGrid& grid;
  const RayBundle& bundle;
  const RayEnds& ends;
  VF step_u, step_v, slope, sky_way, per_u, per_v, per_diagonal, s;
  VI column, row, origin_column, origin_row, level, wraps;
  VI level_offset;  // offset of the lane's level in the pyramid; updating it costs less than looking it up
  MI active;
  int next = 0;  ///< the next ray to give out
  HWY_ALIGN std::int32_t ray_of_lane[kMostLanes];

  Lanes(const RayGrid& g, const RayBundle& b, const RayEnds& e)
      : grid(g),
        bundle(b),
        ends(e),
        s(hn::Zero(kF)),
        column(hn::Zero(kI)),
        row(hn::Zero(kI)),
        origin_column(hn::Zero(kI)),
        origin_row(hn::Zero(kI)),
        level(hn::Zero(kI)),
        wraps(hn::Zero(kI)),
        level_offset(hn::Zero(kI)) {
    std::fill(std::begin(ray_of_lane), std::end(ray_of_lane), -1);
    refill();
  }

  /// Gives the next rays to the lanes that finished theirs; lanes for which none is left go idle.
  void refill() {
    HWY_ALIGN std::int32_t is_new[kMostLanes] = {};
    HWY_ALIGN std::int32_t is_active[kMostLanes];
    for (std::size_t lane = 0; lane < hn::Lanes(kI); ++lane) {
      while (next < bundle.count && bundle.sky_way[next] <= 0) ends.cell[next++] = kSky;
      if (ray_of_lane[lane] < 0 && next < bundle.count) {
        ray_of_lane[lane] = next++;
        is_new[lane] = -1;
      }
      is_active[lane] = ray_of_lane[lane] >= 0 ? -1 : 0;
    }
    active = hn::MaskFromVec(hn::Load(kI, is_active));
    const MI fresh = hn::MaskFromVec(hn::Load(kI, is_new));
    const VI ray = hn::Max(hn::Load(kI, ray_of_lane), hn::Zero(kI));
    step_u = away_from_zero(hn::GatherIndex(kF, bundle.step_u, ray));
    step_v = away_from_zero(hn::GatherIndex(kF, bundle.step_v, ray));
    slope = hn::GatherIndex(kF, bundle.slope, ray);
    sky_way = hn::GatherIndex(kF, bundle.sky_way, ray);
    const VF one = hn::Set(kF, 1.0F);
    per_u = hn::Div(one, step_u);
    per_v = hn::Div(one, step_v);
    per_diagonal = hn::Div(one, hn::Sub(step_u, step_v));
    origin_column = hn::IfThenElse(fresh, set_int(bundle.column), origin_column);
    origin_row = hn::IfThenElse(fresh, set_int(bundle.row), origin_row);
    s = hn::IfThenZeroElse(to_float(fresh), s);
    level = hn::IfThenZeroElse(fresh, level);
    level_offset = hn::IfThenZeroElse(fresh, level_offset);
    wraps = hn::IfThenZeroElse(fresh, wraps);
    // Where a ray runs to smaller indices, its first cell is the one before the vertex.
    const VI first_column =
        hn::Sub(set_int(bundle.column), hn::IfThenElseZero(to_int(hn::Le(step_u, hn::Zero(kF))), set_int(1)));
    const VI first_row =
        hn::Sub(set_int(bundle.row), hn::IfThenElseZero(to_int(hn::Le(step_v, hn::Zero(kF))), set_int(1)));
    column = hn::IfThenElse(fresh, first_column, column);
    row = hn::IfThenElse(fresh, first_row, row);
  }

  /// Brings lanes that have left the map back by a whole tile; returns the lanes for which nothing lies
  /// beyond.
  MI wrap() {
    const VI columns = set_int(grid.cell_columns);
    const VI rows = set_int(grid.cell_rows);
    const VI zero = hn::Zero(kI);
    const MI left = hn::Lt(column, zero);
    const MI right = hn::Not(hn::Lt(column, columns));
    const MI above = hn::Lt(row, zero);
    const MI below = hn::Not(hn::Lt(row, rows));
    const MI outside = hn::And(active, hn::Or(hn::Or(left, right), hn::Or(above, below)));
    if (HWY_LIKELY(hn::AllFalse(kI, outside))) return outside;
    const VI shift_u = hn::IfThenElse(left, columns, hn::IfThenElseZero(right, hn::Neg(columns)));
    const VI shift_v = hn::IfThenElse(above, rows, hn::IfThenElseZero(below, hn::Neg(rows)));
    wraps = hn::Add(wraps, hn::IfThenElseZero(outside, set_int(1)));
    const MI ended = grid.tiles ? hn::And(outside, hn::Gt(wraps, set_int(kMostWraps))) : outside;
    column = hn::Add(column, hn::IfThenElseZero(outside, shift_u));
    row = hn::Add(row, hn::IfThenElseZero(outside, shift_v));
    origin_column = hn::Add(origin_column, hn::IfThenElseZero(outside, shift_u));
    origin_row = hn::Add(origin_row, hn::IfThenElseZero(outside, shift_v));
    return ended;
  }

  VF rise_at(VF way) const { return hn::Mul(way, slope); }

  Cells gather_cells() const {
    const VI one = set_int(1);
    const VI beyond_right = hn::Add(column, one);
    const VI right = hn::IfThenZeroElse(hn::Eq(beyond_right, set_int(grid.width)), beyond_right);
    const VI beyond_below = hn::Add(row, one);
    const VI below = grid.tiles
                         ? hn::IfThenZeroElse(hn::Eq(beyond_below, set_int(grid.cell_rows)), beyond_below)
                         : beyond_below;
    const VI width = set_int(grid.width);
    const VI upper = hn::Mul(row, width);
    const VI lower = hn::Mul(below, width);
    const auto above_receiver = [&](VI vertex) {
      return hn::Sub(hn::GatherIndex(kF, grid.height, vertex), hn::Set(kF, bundle.height));
    };
    return {above_receiver(hn::Add(upper, column)), above_receiver(hn::Add(upper, right)),
            above_receiver(hn::Add(lower, column)), above_receiver(hn::Add(lower, right))};
  }

  MF blocked_in_cell(VF s_exit, VF& across, VF& down) const {
    const Cells cells = gather_cells();
    const VF zero = hn::Zero(kF);
    const VF left = hn::ConvertTo(kF, hn::Sub(column, origin_column));
    const VF top = hn::ConvertTo(kF, hn::Sub(row, origin_row));
    const auto u_at = [&](VF way) { return clamp_unit(hn::Sub(hn::Mul(way, step_u), left)); };
    const auto v_at = [&](VF way) { return clamp_unit(hn::Sub(hn::Mul(way, step_v), top)); };

    const VF d_exit = hn::Sub(cells.height_at(u_at(s_exit), v_at(s_exit)), rise_at(s_exit));
    const VF s_diagonal = hn::Mul(hn::Sub(left, top), per_diagonal);
    const MF has_diagonal = hn::And(hn::Gt(s_diagonal, s), hn::Lt(s_diagonal, s_exit));
    const VF along = u_at(s_diagonal);
    const VF on_diagonal =
        hn::Add(cells.upper_left, hn::Mul(along, hn::Sub(cells.lower_right, cells.upper_left)));
    const VF d_diagonal = hn::Sub(on_diagonal, rise_at(s_diagonal));
    const MF blocked_at_diagonal = hn::And(has_diagonal, hn::Gt(d_diagonal, zero));
    const VF d_enter = hn::Sub(cells.height_at(u_at(s), v_at(s)), rise_at(s));
    const MF enters_below = hn::And(hn::Gt(s, zero), hn::Gt(d_enter, zero));
    const MF blocked = hn::Or(enters_below, hn::Or(blocked_at_diagonal, hn::Gt(d_exit, zero)));
    if (hn::AllFalse(kF, blocked)) return blocked;

    const MF from_diagonal = hn::AndNot(blocked_at_diagonal, has_diagonal);
    const VF s_before = hn::IfThenElse(from_diagonal, s_diagonal, s);
    const VF d_before = hn::IfThenElse(from_diagonal, d_diagonal, d_enter);
    const VF s_after = hn::IfThenElse(blocked_at_diagonal, s_diagonal, s_exit);
    const VF d_after = hn::IfThenElse(blocked_at_diagonal, d_diagonal, d_exit);
    const VF crossing = hn::Div(d_before, hn::Sub(d_before, d_after));
    const VF share = hn::IfThenElse(hn::Le(d_before, zero), crossing, hn::Set(kF, 1.0F));
    const VF s_crossing = hn::Add(s_before, hn::Mul(share, hn::Sub(s_after, s_before)));
    const VF s_hit = hn::IfThenElse(enters_below, s, s_crossing);
    const MF own_facet = hn::AndNot(enters_below, hn::Eq(s_before, zero));
    const VF middle = hn::Mul(hn::Set(kF, 0.5F), s_after);
    const MF upper_right = hn::Ge(u_at(middle), v_at(middle));
    const VF one_third = hn::Set(kF, kOneThird);
    const VF two_thirds = hn::Set(kF, kTwoThirds);
    across = hn::IfThenElse(own_facet, hn::IfThenElse(upper_right, two_thirds, one_third), u_at(s_hit));
    down = hn::IfThenElse(own_facet, hn::IfThenElse(upper_right, one_third, two_thirds), v_at(s_hit));
    return blocked;
  }

  /// Stores the results of the rays that have ended, and marks their lanes as free.
  void write_down(MI ends_here, MI hit, VF across, VF down) {
    HWY_ALIGN std::int32_t cell[kMostLanes];
    HWY_ALIGN float across_of_lane[kMostLanes];
    HWY_ALIGN float down_of_lane[kMostLanes];
    HWY_ALIGN std::int32_t ended[kMostLanes];
    const VI place = hn::Add(hn::Mul(row, set_int(grid.width)), column);
    hn::Store(hn::IfThenElse(hit, place, set_int(kSky)), kI, cell);
    hn::Store(across, kF, across_of_lane);
    hn::Store(down, kF, down_of_lane);
    hn::Store(hn::VecFromMask(kI, ends_here), kI, ended);
    for (std::size_t lane = 0; lane < hn::Lanes(kI); ++lane) {
      if (ended[lane] == 0) continue;
      const std::int32_t ray = ray_of_lane[lane];
      ends.cell[ray] = cell[lane];
      ends.across[ray] = across_of_lane[lane];
      ends.down[ray] = down_of_lane[lane];
      ray_of_lane[lane] = -1;
    }
  }

  bool is_done() const { return hn::AllFalse(kI, active); }

  /// Moves every lane by one block: to the sky, down into the block, to the hit in the block's cell, or past
  /// it.
  void step() {
    MI sky = wrap();
    const Block block = find_block();
    const VF zero_f = hn::Zero(kF);
    const VF lowest = rise_at(hn::IfThenElse(hn::Lt(slope, zero_f), block.s_exit, s));
    sky = hn::Or(sky, hn::And(active, to_int(hn::Ge(s, sky_way))));
    const MI going = hn::AndNot(sky, active);

    const VI entry = hn::IfThenElseZero(going, pyramid_index());
    const VF block_highest =
        hn::Sub(hn::GatherIndex(kF, grid.pyramid->highest.data(), entry), hn::Set(kF, bundle.height));
    const MI near = hn::And(going, to_int(hn::Lt(lowest, block_highest)));
    const MI descends = hn::And(near, hn::Gt(level, hn::Zero(kI)));
    const MI at_cell = hn::AndNot(descends, near);

    MI hit = hn::MaskFromVec(hn::Zero(kI));
    VF across = zero_f;
    VF down = zero_f;
    MI stays = at_cell;
    const std::size_t cells = hn::CountTrue(kI, at_cell);
    if (cells >= kCellsDue || (cells > 0 && cells == hn::CountTrue(kI, going))) {
      hit = enter_cells(at_cell, block.s_exit, across, down);
      stays = hit;
    }
    const MI advances = hn::AndNot(hn::Or(descends, stays), going);
    const MI climbs = advance(block, advances);
    change_level(descends, climbs);

    const MI ends_here = hn::Or(sky, hit);
    if (hn::AllFalse(kI, ends_here)) return;
    write_down(ends_here, hit, across, down);
    active = hn::AndNot(ends_here, active);
    if (hn::CountTrue(kI, active) + kRefillsDue <= hn::Lanes(kI) || hn::AllFalse(kI, active)) refill();
  }

 private:
  /// The block of the pyramid that a lane is in, in cells, and how the ray leaves the block.
  struct Block {
    VI left, top, right, bottom;
    MI up_u, up_v;  ///< the ray runs to larger columns (u), rows (v)
    MI crosses_u;   ///< the ray leaves by a column's border, not a row's
    VI border;      ///< index of that border
    VF s_exit;
  };

  Block find_block() const {
    const VI size = hn::Shl(set_int(1), level);
    const VI mask = hn::Neg(size);
    Block block;
    block.left = hn::And(column, mask);
    block.top = hn::And(row, mask);
    block.right = hn::Min(hn::Add(block.left, size), set_int(grid.cell_columns));
    block.bottom = hn::Min(hn::Add(block.top, size), set_int(grid.cell_rows));
    block.up_u = to_int(hn::Gt(step_u, hn::Zero(kF)));
    block.up_v = to_int(hn::Gt(step_v, hn::Zero(kF)));
    const VI border_u = hn::IfThenElse(block.up_u, block.right, block.left);
    const VI border_v = hn::IfThenElse(block.up_v, block.bottom, block.top);
    const VF s_u = hn::Mul(hn::ConvertTo(kF, hn::Sub(border_u, origin_column)), per_u);
    const VF s_v = hn::Mul(hn::ConvertTo(kF, hn::Sub(border_v, origin_row)), per_v);
    block.crosses_u = to_int(hn::Le(s_u, s_v));
    block.border = hn::IfThenElse(block.crosses_u, border_u, border_v);
    block.s_exit = hn::Max(s, hn::Min(s_u, s_v));
    return block;
  }

  VI pyramid_index() const {
    const VI stride = hn::Sub(set_int(grid.pyramid->stride_bits), level);
    return hn::Add(level_offset, hn::Add(hn::Shl(hn::Shr(row, level), stride), hn::Shr(column, level)));
  }

  /// Moves lanes into the cell beyond their block; returns the lanes that have left the block's parent, too.
  MI advance(const Block& block, MI advances) {
    const VI one = set_int(1);
    const VI along_u = clamp_cell(origin_column, hn::Mul(block.s_exit, step_u), block.left, block.right);
    const VI along_v = clamp_cell(origin_row, hn::Mul(block.s_exit, step_v), block.top, block.bottom);
    const VI beyond_u = hn::IfThenElse(block.up_u, block.right, hn::Sub(block.left, one));
    const VI beyond_v = hn::IfThenElse(block.up_v, block.bottom, hn::Sub(block.top, one));
    column = hn::IfThenElse(advances, hn::IfThenElse(block.crosses_u, beyond_u, along_u), column);
    row = hn::IfThenElse(advances, hn::IfThenElse(block.crosses_u, along_v, beyond_v), row);
    s = hn::IfThenElse(to_float(advances), block.s_exit, s);
    const VI last_border =
        hn::IfThenElse(block.crosses_u, set_int(grid.cell_columns), set_int(grid.cell_rows));
    const VI parent_mask = hn::Sub(hn::Shl(set_int(2), level), one);
    const MI leaves_parent =
        hn::Or(hn::Eq(hn::And(block.border, parent_mask), hn::Zero(kI)), hn::Eq(block.border, last_border));
    return hn::And(advances, hn::And(leaves_parent, hn::Lt(level, set_int(grid.pyramid->levels - 1))));
  }

  /// When a lane changes its level, its offset changes by the number of entries of the lower of the two
  /// levels.
  void change_level(MI descends, MI climbs) {
    const VI one = set_int(1);
    const VI lower_level = hn::Sub(level, hn::IfThenElseZero(descends, one));
    const VI rows = hn::Add(hn::Shr(set_int(grid.cell_rows - 1), lower_level), one);
    const VI entries = hn::Shl(rows, hn::Sub(set_int(grid.pyramid->stride_bits), lower_level));
    level = hn::Add(lower_level, hn::IfThenElseZero(climbs, one));
    level_offset = hn::Add(level_offset, hn::IfThenElseZero(climbs, entries));
    level_offset = hn::Sub(level_offset, hn::IfThenElseZero(descends, entries));
  }

  /// Calls `blocked_in_cell` for some lanes. The others look at the map's first cell, so that no index is out
  /// of range.
  MI enter_cells(MI at_cell, VF s_exit, VF& across, VF& down) {
    const VI keep_column = column;
    const VI keep_row = row;
    column = hn::IfThenElseZero(at_cell, column);
    row = hn::IfThenElseZero(at_cell, row);
    const MI hit = hn::And(at_cell, to_int(blocked_in_cell(s_exit, across, down)));
    column = keep_column;
    row = keep_row;
    return hit;
  }

  VI clamp_cell(VI origin, VF way, VI low, VI beyond) const {
    const VI whole = hn::Add(origin, hn::ConvertTo(kI, hn::Floor(way)));
    return hn::Min(hn::Max(whole, low), hn::Sub(beyond, set_int(1)));
  }
};

void traverse_lanes(const RayGrid& grid, const RayBundle& bundle, const RayEnds& ends) {
  Lanes lanes(grid, bundle, ends);
  while (!lanes.is_done()) lanes.step();
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(traverse_lanes);

void traverse(const RayGrid& grid, const RayBundle& bundle, const RayEnds& ends) {
  HWY_DYNAMIC_DISPATCH(traverse_lanes)(grid, bundle, ends);
}

}  // namespace heightlight
#endif
