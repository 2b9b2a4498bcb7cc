#include "transport/field_gather.h"

#include <cmath>

#include "base/texel_algebra.h"
#include "base/texels.h"

namespace heightlight {
TexelVector gather_field(const FieldGather& gather, const TexelVector& x, GatherTurn turn) {
  turn.sky = &gather.sky;
  const double unit = unit_of(x);
  Map field(gather.sky.width, gather.sky.height);
  for_texels(field, [&](std::size_t i) {
    const bool missing = std::isnan(gather.sky.values[i]);
    field.values[i] = missing ? gather.sky.values[i] : static_cast<float>(x[i] / unit);
  });
  FieldPyramid pyramid = gather.gather.make_pyramid();
  pyramid.fill(field);
  TexelVector result(x.size());
  gather.gather.run(
      turn, {&pyramid},
      [&](const ReceiverTile& tile, const GatherSums& sums) {
        for_present(tile, [&](std::size_t at, int row, int column) {
          const std::size_t i = field.index(row, column);
          // A receiver that sees nothing along these azimuths, but has A < 1, is taken to see its own value.
          const double seen = sums.weight[at] > 0 ? double{sums.weighted[0][at]} / double{sums.weight[at]}
                                                  : double{field.values[i]};
          result[i] = unit * ((1 - gather.direct[i]) * seen);
        });
      },
      gather.watch);
  return result;
}

TexelVector find_surface_share(const FieldGather& gather, const GatherTurn& turn) {
  FieldPyramid any = gather.gather.make_pyramid();
  any.fill(gather.sky);
  TexelVector share(gather.direct.size());
  gather.gather.run(
      turn, {&any},
      [&](const ReceiverTile& tile, const GatherSums& sums) {
        for_present(tile, [&](std::size_t at, int row, int column) {
          share[gather.sky.index(row, column)] = double{sums.weight[at]};
        });
      },
      gather.watch);
  return share;
}

}  // namespace heightlight
