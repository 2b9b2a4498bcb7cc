#include "transport/receiver_lattice.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"

namespace heightlight {

ReceiverLattice::ReceiverLattice(const Surface& surface, int receiver_stride)
    : stride(receiver_stride),
      width((surface.width() + stride - 1) / stride),
      height((surface.height() + stride - 1) / stride) {}

bool ReceiverLattice::fits(const Surface& surface, int receiver_stride) {
  constexpr int kLeastSide = 64;
  const ReceiverLattice lattice(surface, receiver_stride);
  const bool divides = surface.width() % receiver_stride == 0 && surface.height() % receiver_stride == 0;
  return std::min(lattice.width, lattice.height) >= kLeastSide && (divides || !surface.tiles()) &&
         count_missing(surface.map) == 0;
}

Surface lattice_surface(const Surface& surface, const ReceiverLattice& lattice) {
  Heightmap map = surface.map;
  map.height = Image<float>(lattice.width, lattice.height);
  map.spacing = {surface.map.spacing.x * lattice.stride, surface.map.spacing.y * lattice.stride};
  for (int row = 0; row < lattice.height; ++row) {
    for (int column = 0; column < lattice.width; ++column) {
      map.height(row, column) = surface.map.height(row * lattice.stride, column * lattice.stride);
    }
  }
  return build_surface(std::move(map));
}

TexelVector take_lattice(const Surface& surface, const ReceiverLattice& lattice, const TexelVector& values) {
  TexelVector taken(static_cast<std::size_t>(lattice.width) * static_cast<std::size_t>(lattice.height));
  parallel_for(lattice.height, [&](std::int64_t row) {
    for (std::int64_t column = 0; column < lattice.width; ++column) {
      taken[static_cast<std::size_t>(row * lattice.width + column)] =
          values[static_cast<std::size_t>(row * lattice.stride * surface.width() + column * lattice.stride)];
    }
  });
  return taken;
}

void spread_lattice(const Surface& surface, const ReceiverLattice& lattice, const Image<float>& values,
                    Image<float>& spread) {
  const int stride = lattice.stride;
  const auto next = [&](int i, int count) { return i + 1 < count ? i + 1 : surface.tiles() ? 0 : i; };
  parallel_for(surface.height(), [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    const int above = row / stride;
    const float* upper = &values(above, 0);
    const float* lower = &values(next(above, lattice.height), 0);
    const float down = static_cast<float>(row % stride) / static_cast<float>(stride);
    const auto between_rows = [&](int column) {
      return upper[column] + down * (lower[column] - upper[column]);
    };
    float* out = &spread(row, 0);
    for (int column = 0; column < lattice.width; ++column) {
      const float left = between_rows(column);
      const float step = (between_rows(next(column, lattice.width)) - left) / static_cast<float>(stride);
      const int inside = std::min(stride, surface.width() - column * stride);
      for (int k = 0; k < inside; ++k) *out++ = left + static_cast<float>(k) * step;
    }
  });
}

}  // namespace heightlight
