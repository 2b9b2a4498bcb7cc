#pragma once

#include <array>
#include <string>
#include <vector>

#include "embree_mesh.h"
#include "ray_lattice.h"
#include "receivers.h"

namespace heightlight {

/// How rays are passed to Embree: one by one, in packets, or as a stream of some thousands.
enum class EmbreeCall { single, packet8, packet16, stream };
struct EmbreeMode {
  EmbreeCall call = EmbreeCall::single;
  RTCIntersectContextFlags coherence = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
};
std::string to_string(EmbreeMode mode);

/// Sky view factors by occlusion rays that Embree traces, sent as a program built on Embree would send them:
/// the ray lattices are made once and rotated per texel, as for our rays, and occlusion is queried without a
/// hit.
class EmbreeRays {
 public:
  /// `surface` and `mesh` must outlive this object.
  EmbreeRays(const Surface& surface, const EmbreeMesh& mesh, EmbreeMode mode, RayDensity density, int rays);

  std::vector<float> sky_view_factors(const Receivers& receivers) const;

 private:
  /// The origin of a receiver's rays and the axes of its lattice; x = column, y = row, z = height / spacing.
  struct Stand {
    const RayLattice* lattice;
    std::array<float, 3> origin, tangent, bitangent, normal;
  };

  LatticeTurn turn_at(std::size_t receiver) const;
  const RayLattice& lattice_of(const LatticeTurn& turn) const;
  Stand stand_at(std::size_t receiver) const;
  RTCIntersectContext context() const;
  void trace_run(const std::size_t* receivers, std::size_t count, float* sky) const;
  void trace_stream(const std::size_t* receivers, std::size_t count, float* sky) const;
  template <int kWidth, class Packet, class Occluded>
  float trace_packets(const Stand& stand, Packet packet, const Occluded& occluded) const;

  const Surface& surface_;
  const EmbreeMesh& mesh_;
  EmbreeMode mode_;
  std::size_t rays_;
  HemisphereDirections directions_;
  std::array<RayLattice, HemisphereDirections::kTables> lattices_;
};

}  // namespace heightlight
