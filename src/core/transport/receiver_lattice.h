#pragma once

#include "heightlight/transport.h"

// Where what is seen changes slowly from receiver to receiver, every second or fourth one is enough: what the
// others see is interpolated between them, and only how much of it they see, 1 − A, is their own. The
// lattice's receivers live on the surface of their own samples, so that everything which works on a map works
// on it too.

namespace heightlight {

/// Every stride-th row and column of a map, from the first on.
struct ReceiverLattice {
  int stride = 1;
  int width = 0;  ///< of the lattice
  int height = 0;

  ReceiverLattice(const Surface& surface, int receiver_stride);

  /// Whether a lattice fits the map: no holes, sides that it divides under `tile`, and 64 receivers a side.
  static bool fits(const Surface& surface, int receiver_stride);
};

/// The surface of a lattice's samples.
Surface lattice_surface(const Surface& surface, const ReceiverLattice& lattice);

/// Values of all texels at the lattice's.
TexelVector take_lattice(const Surface& surface, const ReceiverLattice& lattice, const TexelVector& values);

/// Into `spread`, per texel, the lattice's values interpolated bilinearly (beyond the last receiver of an
/// open map: that one's).
void spread_lattice(const Surface& surface, const ReceiverLattice& lattice, const Image<float>& values,
                    Image<float>& spread);

}  // namespace heightlight
