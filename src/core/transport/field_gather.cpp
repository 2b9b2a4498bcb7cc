#include "transport/field_gather.h"

#include <algorithm>
#include <cmath>

#include "base/texel_algebra.h"
#include "base/texels.h"

namespace heightlight {
namespace {

/// The power of two by which light that single precision might lose is gathered brighter.
int dimness(const TexelVector& x) {
  constexpr int kDimmest = -40;
  int exponent = 0;
  const double brightest = as_eigen(x).cwiseAbs().maxCoeff();
  std::frexp(brightest, &exponent);
  if (brightest == 0 || exponent >= kDimmest) return 0;
  return std::max(exponent, -1000);  // of what is dimmer still the power would be infinite
}

}  // namespace

TexelVector gather_field(const FieldGather& gather, const TexelVector& x, GatherTurn turn) {
  turn.sky = &gather.sky;
  const int exponent = dimness(x);
  Map field(gather.sky.width, gather.sky.height);
  for_texels(field, [&](std::size_t i) {
    const bool missing = std::isnan(gather.sky.values[i]);
    field.values[i] = missing ? gather.sky.values[i] : static_cast<float>(std::ldexp(x[i], -exponent));
  });
  FieldPyramid pyramid = gather.gather.make_pyramid();
  pyramid.fill(field);
  TexelVector result(x.size());
  gather.gather.run(
      turn, {&pyramid},
      [&](const ReceiverTile& tile, const GatherSums& sums) {
        for_present(tile, [&](std::size_t at, int row, int column) {
          const std::size_t i = field.index(row, column);
          // Who sees nothing along these azimuths, but has A < 1, sees its like.
          const double seen = sums.weight[at] > 0 ? double{sums.weighted[0][at]} / double{sums.weight[at]}
                                                  : double{field.values[i]};
          result[i] = std::ldexp((1 - gather.direct[i]) * seen, exponent);
        });
      },
      gather.watch);
  return result;
}

}  // namespace heightlight
