// The arithmetic is the same as in point_scalar.cpp. Places differ from lane to lane, so heights are
// gathered.

#include "screenspace/point_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screenspace/point_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "screenspace/slice_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace heightlight::HWY_NAMESPACE {

using I = hn::RebindToSigned<F>;
using VI = hn::Vec<I>;
constexpr I kI;

struct Vector {
  VF x, y, z;
};

HWY_INLINE Vector combine(VF a, const Vector& v, VF b, const Vector& w) {
  return {hn::MulAdd(a, v.x, hn::Mul(b, w.x)), hn::MulAdd(a, v.y, hn::Mul(b, w.y)),
          hn::MulAdd(a, v.z, hn::Mul(b, w.z))};
}

HWY_INLINE VF dot(const Vector& v, const Vector& w) {
  return hn::MulAdd(v.x, w.x, hn::MulAdd(v.y, w.y, hn::Mul(v.z, w.z)));
}

/// One vector of receivers with their frames.
struct Framed {
  VF row, column, height;
  Vector tangent, bitangent, normal;
};

struct Place {
  VF u, v;
};

class PointLanes {
 public:
  explicit PointLanes(const PointPass& pass) : pass_(pass), depth_(pass.depth) {}

  Framed frame(const Receivers& at, std::size_t v) const {
    const VF n_z = at.normal_z[v];
    Framed framed;
    framed.row = hn::Set(kF, static_cast<float>(at.row));
    const auto first = at.column + static_cast<int>(v * hn::Lanes(kF)) * DepthBuffer::kPhases;
    const VF phases = hn::Set(kF, static_cast<float>(DepthBuffer::kPhases));
    framed.column = hn::MulAdd(hn::Iota(kF, 0), phases, hn::Set(kF, static_cast<float>(first)));
    framed.height = at.height[v];
    framed.normal = {hn::Neg(hn::Mul(at.slope_x[v], n_z)), hn::Neg(hn::Mul(at.slope_y[v], n_z)), n_z};
    const Vector& n = framed.normal;
    const VF hundredth = hn::Set(kF, 0.01F);
    Vector t{hn::Sub(hn::Mul(hundredth, n.y), n.z), hn::Neg(hn::Mul(hundredth, n.x)), n.x};
    const VF length = hn::Sqrt(dot(t, t));
    t = {hn::Div(t.x, length), hn::Div(t.y, length), hn::Div(t.z, length)};
    const Vector b{hn::NegMulAdd(n.z, t.y, hn::Mul(n.y, t.z)), hn::NegMulAdd(n.x, t.z, hn::Mul(n.z, t.x)),
                   hn::NegMulAdd(n.y, t.x, hn::Mul(n.x, t.y))};
    const auto rank = static_cast<std::size_t>(noise_rank(at.row, at.column));
    const VF cosine = hn::Set(kF, pass_.turn_cosine[rank]);
    const VF sine = hn::Set(kF, pass_.turn_sine[rank]);
    framed.tangent = combine(cosine, t, sine, b);
    framed.bitangent = combine(cosine, b, hn::Neg(sine), t);
    return framed;
  }

  static Vector offset_of(const Framed& at, const TangentPoint& point) {
    const Vector level = combine(hn::Set(kF, point.x), at.tangent, hn::Set(kF, point.y), at.bitangent);
    const VF z = hn::Set(kF, point.z);
    return {hn::MulAdd(z, at.normal.x, level.x), hn::MulAdd(z, at.normal.y, level.y),
            hn::MulAdd(z, at.normal.z, level.z)};
  }

  Place place_of(const Framed& at, VF x, VF y) const {
    Place place{hn::MulAdd(x, hn::Set(kF, static_cast<float>(1 / depth_.spacing.x)), at.column),
                hn::NegMulAdd(y, hn::Set(kF, static_cast<float>(1 / depth_.spacing.y)), at.row)};
    if (depth_.boundary == Boundary::open) {
      const VF before = hn::Set(kF, -1.0F);
      place.u = hn::Min(hn::Max(place.u, before), hn::Set(kF, static_cast<float>(depth_.width)));
      place.v = hn::Min(hn::Max(place.v, before), hn::Set(kF, static_cast<float>(depth_.height)));
    }
    return place;
  }

  VF height_at(const Place& place) const {
    const VF left = hn::Floor(place.u);
    const VF top = hn::Floor(place.v);
    const VF across = hn::Sub(place.u, left);
    const VF down = hn::Sub(place.v, top);
    const VI column = around(left, depth_.period_columns);
    const VI row = around(top, depth_.period_rows);
    const VI next_column = next(column, depth_.period_columns);
    const VI next_row = next(row, depth_.period_rows);
    const auto upper_right = hn::RebindMask(kI, hn::Ge(across, down));
    const VI middle_row = hn::IfThenElse(upper_right, row, next_row);
    const VI middle_column = hn::IfThenElse(upper_right, next_column, column);
    const VF corner = look_up(row, column);
    const VF middle = look_up(middle_row, middle_column);
    const VF opposite = look_up(next_row, next_column);
    const VF corner_share = hn::Sub(hn::Set(kF, 1.0F), hn::Max(across, down));
    const VF middle_share = hn::Abs(hn::Sub(across, down));
    return hn::MulAdd(corner_share, corner,
                      hn::MulAdd(middle_share, middle, hn::Mul(hn::Min(across, down), opposite)));
  }

  /// Index in a map, row by row, of the texel nearest to a place.
  VI texel_at(const Place& place) const {
    const VF half = hn::Set(kF, 0.5F);
    const VI row = hn::Min(around(hn::Floor(hn::Add(place.v, half)), depth_.period_rows),
                           hn::Set(kI, depth_.height - 1));
    const VI column = hn::Min(around(hn::Floor(hn::Add(place.u, half)), depth_.period_columns),
                              hn::Set(kI, depth_.width - 1));
    return hn::Add(hn::Mul(row, hn::Set(kI, depth_.width)), column);
  }

  /// Index of the sky's cell in that direction.
  static VI cell_of(const SkyGrid& sky, const Vector& way) {
    const VF one = hn::Set(kF, 1.0F);
    const VF size = hn::Add(hn::Add(hn::Abs(way.x), hn::Abs(way.y)), hn::Abs(way.z));
    const VF safe = hn::Max(size, hn::Set(kF, 1e-30F));
    const VF x = hn::Div(way.x, safe);
    const VF y = hn::Div(way.y, safe);
    const auto below = hn::Lt(way.z, hn::Zero(kF));
    const VF across = hn::IfThenElse(below, hn::CopySign(hn::Sub(one, hn::Abs(y)), x), x);
    const VF down = hn::IfThenElse(below, hn::CopySign(hn::Sub(one, hn::Abs(x)), y), y);
    const VI side = hn::Set(kI, sky.side);
    return hn::Add(hn::Mul(cell_along(sky, down), side), cell_along(sky, across));
  }

  /// As hidden_share in point_scalar.cpp: 0 where no place is below the surface.
  VF hidden_share(const Framed& at, const Vector& offset) const {
    VF hidden = hn::Zero(kF);
    const VF bias = hn::Set(kF, pass_.bias);
    for (int test = pass_.tests; test >= 1; --test) {  // the nearest place decides
      const VF share = hn::Set(kF, static_cast<float>(test) / static_cast<float>(pass_.tests));
      const Place place = place_of(at, hn::Mul(share, offset.x), hn::Mul(share, offset.y));
      const VF above = hn::Sub(hn::Sub(height_at(place), at.height), hn::Mul(share, offset.z));
      hidden = hn::IfThenElse(hn::Ge(above, bias), share, hidden);
    }
    return hidden;
  }

 private:
  static VI cell_along(const SkyGrid& sky, VF share) {
    const VF half = hn::Set(kF, 0.5F * static_cast<float>(sky.side));
    const VI cell = hn::ConvertTo(kI, hn::Mul(hn::Add(share, hn::Set(kF, 1.0F)), half));
    return hn::Min(hn::Max(cell, hn::Zero(kI)), hn::Set(kI, sky.side - 1));
  }

  static VI around(VF i, int period) {
    const VF count = hn::Set(kF, static_cast<float>(period));
    return hn::ConvertTo(kI, hn::NegMulAdd(count, hn::Floor(hn::Div(i, count)), i));
  }

  static VI next(VI i, int period) {
    const VI after = hn::Add(i, hn::Set(kI, 1));
    return hn::IfThenZeroElse(hn::Eq(after, hn::Set(kI, period)), after);
  }

  VF look_up(VI row, VI column) const {
    static_assert(DepthBuffer::kPhases == 4);
    const VI phase_row = hn::Add(hn::ShiftLeft<2>(row), hn::And(column, hn::Set(kI, 3)));
    const VI at = hn::Add(hn::Mul(phase_row, hn::Set(kI, depth_.stride)), hn::ShiftRight<2>(column));
    return hn::GatherIndex(kF, depth_.heights.data(), at);
  }

  const PointPass& pass_;
  const DepthBuffer& depth_;
};

HWY_INLINE Lanes no_lanes() {
  Lanes lanes;
  for (VF& lane : lanes) lane = hn::Zero(kF);
  return lanes;
}

void test_points_lanes(const PointPass& pass, int row, PointSums& sums) {
  const PointLanes lanes(pass);
  for_receivers(pass.depth, row, [&](const Receivers& at) {
    Lanes open = no_lanes();
    std::array<Lanes, 3> sky{no_lanes(), no_lanes(), no_lanes()};
    std::array<Lanes, kMostAlbedos> albedo{no_lanes(), no_lanes(), no_lanes()};
    for (std::size_t v = 0; v < kBunch; ++v) {
      const Framed framed = lanes.frame(at, v);
      for (const TangentPoint& point : pass.points) {
        const Vector offset = PointLanes::offset_of(framed, point);
        const VF hidden = lanes.hidden_share(framed, offset);
        const VF weight = hn::Set(kF, point.weight);
        const auto is_open = hn::Eq(hidden, hn::Zero(kF));
        const VF counted = hn::IfThenElseZero(is_open, weight);
        open[v] = hn::Add(open[v], counted);
        if (pass.sky) {
          const VI cell = PointLanes::cell_of(*pass.sky, offset);
          const VF all = hn::Add(counted, hn::Set(kF, point.kept));
          sky[0][v] = hn::MulAdd(all, hn::GatherIndex(kF, pass.sky->red.data(), cell), sky[0][v]);
          sky[1][v] = hn::MulAdd(all, hn::GatherIndex(kF, pass.sky->green.data(), cell), sky[1][v]);
          sky[2][v] = hn::MulAdd(all, hn::GatherIndex(kF, pass.sky->blue.data(), cell), sky[2][v]);
        }
        if (pass.albedos.empty() || hn::AllTrue(kF, is_open)) continue;
        const VI texel =
            lanes.texel_at(lanes.place_of(framed, hn::Mul(hidden, offset.x), hn::Mul(hidden, offset.y)));
        for (std::size_t a = 0; a < pass.albedos.size(); ++a) {
          const VF found = hn::GatherIndex(kF, pass.albedos[a]->values.data(), texel);
          albedo[a][v] = hn::Add(albedo[a][v], hn::IfThenZeroElse(is_open, hn::Mul(weight, found)));
        }
      }
    }
    add_to_row(open, at.column, sums.open);
    for (std::size_t c = 0; c < sky.size() && pass.sky; ++c) add_to_row(sky[c], at.column, sums.sky[c]);
    for (std::size_t a = 0; a < pass.albedos.size(); ++a) add_to_row(albedo[a], at.column, sums.albedo[a]);
  });
}

void bounce_points_lanes(const BouncePass& pass, int row, std::vector<float>& received) {
  const DepthBuffer& depth = pass.points.depth;
  const PointLanes lanes(pass.points);
  const VF zero = hn::Zero(kF);
  const VF least = hn::Set(kF, pass.least_distance * pass.least_distance);
  for_receivers(depth, row, [&](const Receivers& at) {
    Lanes sums = no_lanes();
    for (std::size_t v = 0; v < kBunch; ++v) {
      const Framed framed = lanes.frame(at, v);
      for (const TangentPoint& point : pass.points.points) {
        const Vector offset = PointLanes::offset_of(framed, point);
        const auto is_open = hn::Eq(lanes.hidden_share(framed, offset), zero);
        if (hn::AllTrue(kF, is_open)) continue;
        const Place place = lanes.place_of(framed, offset.x, offset.y);
        const VI texel = lanes.texel_at(place);
        const VF radiance = hn::GatherIndex(kF, pass.sender.values.data(), texel);
        const VF n_z = hn::GatherIndex(kF, depth.row_normal_z.values.data(), texel);
        const VF slope_x = hn::GatherIndex(kF, depth.row_slope_x.values.data(), texel);
        const VF slope_y = hn::GatherIndex(kF, depth.row_slope_y.values.data(), texel);
        const Vector way{offset.x, offset.y, hn::Sub(lanes.height_at(place), framed.height)};
        const VF squared = dot(way, way);
        const VF towards = hn::Mul(n_z, hn::Sub(hn::MulAdd(slope_x, way.x, hn::Mul(slope_y, way.y)), way.z));
        const VF cosines = hn::Div(hn::Mul(hn::Max(towards, zero), hn::Max(dot(framed.normal, way), zero)),
                                   hn::Max(squared, hn::Set(kF, 1e-30F)));
        const VF all =
            hn::Div(hn::Mul(hn::Mul(radiance, hn::Set(kF, pass.area)), cosines), hn::Max(squared, least));
        const auto counts = hn::Eq(all, all);  // a hole does not count
        sums[v] = hn::Add(sums[v], hn::IfThenZeroElse(is_open, hn::IfThenElseZero(counts, all)));
      }
    }
    add_to_row(sums, at.column, received);
  });
}

}  // namespace heightlight::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace heightlight {

HWY_EXPORT(test_points_lanes);
HWY_EXPORT(bounce_points_lanes);

void test_points(const PointPass& pass, int row, PointSums& sums) {
  HWY_DYNAMIC_DISPATCH(test_points_lanes)(pass, row, sums);
}

void bounce_points(const BouncePass& pass, int row, std::vector<float>& received) {
  HWY_DYNAMIC_DISPATCH(bounce_points_lanes)(pass, row, received);
}

}  // namespace heightlight
#endif
