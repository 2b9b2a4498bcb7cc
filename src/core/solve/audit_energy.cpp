#include <cmath>

#include "solve/solver.h"

namespace heightlight {

// A texel of the map has the area 1/n_z of its place on the map, and radiosity ρ E. Of what it sends the
// share A goes to the sky, as by reciprocity A is also the share of what it would receive from an even sky.
// Hence
//     Σ E₀/n_z = Σ (1 − ρ) E/n_z + Σ A ρ E/n_z.
EnergyAudit audit_energy(const Surface& surface, const Transport& transport, const LightSystem& system,
                         const TexelVector& total) {
  const TexelVector& direct = system.direct ? *system.direct : transport.direct;
  double area = 0;
  double received = 0;
  double absorbed = 0;
  double escaped = 0;
  for (std::size_t i = 0; i < total.size(); ++i) {
    if (std::isnan(surface.map.height.values[i])) continue;
    const double own = 1 / double{surface.normal.values[i].z};
    const double albedo = system.varying ? (*system.varying)[i] : system.albedo;
    area += own;
    received += own * direct[i];
    absorbed += own * (1 - albedo) * total[i];
    escaped += own * albedo * total[i] * transport.direct[i];
  }
  if (!(received > 0)) return {};
  return {.received = received / area,
          .absorbed = absorbed / received,
          .escaped = escaped / received,
          .imbalance = 1 - (absorbed + escaped) / received};
}

}  // namespace heightlight
