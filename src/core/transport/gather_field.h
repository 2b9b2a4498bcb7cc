#pragma once

#include <vector>

#include "transport/gather_course.h"
#include "transport/map_gather.h"

namespace heightlight {

/// One system while it is being solved: all that is known of its receivers.
struct GatherField {
  const IrradianceSystem& system;
  GatherCourse course = {};
  double unit = 1;      ///< E/π of one unit: unit_of the direct irradiance; 1 under the sky
  Map irradiance = {};  ///< E_k/π in units; NaN where the sample is missing
  Map before = {};      ///< E_{k−1}
  Map weighted = {};    ///< N
  Map weights = {};

  double albedo(std::size_t i) const { return system.varying ? (*system.varying)[i] : system.albedo; }
  /// E₀/π in units, of a receiver with the sky view factor `sky`.
  double direct(std::size_t i, double sky) const { return system.direct ? (*system.direct)[i] / unit : sky; }
};

/// The start: a closed form under the sky; the direct irradiance, before it bounces, for a user-given light.
GatherField start_field(const IrradianceSystem& system, const Map& sky);

/// ρ (E_k − kept E_{k−1})/π: the new radiosity that the next gather reads.
inline float new_radiosity(double albedo, float irradiance, float before, double kept) {
  return static_cast<float>(albedo) * (irradiance - static_cast<float>(kept) * before);
}

/// Where steps are taken: the receivers of a surface, or of a window of it.
struct StepGround {
  const MapGather& gather;
  const Map& sky;  ///< A
  const SkyClasses& classes;
  const Watch& watch;
};

/// Gathers the new radiosity of several fields, and takes one step of each. `turn.sky` is ignored. Returns
/// per field what a step of weight 1 would change; nothing unless `tells`.
std::vector<ChangeSum> take_step(const StepGround& ground, GatherTurn turn,
                                 const std::vector<const FieldPyramid*>& radiosity,
                                 const std::vector<GatherField*>& fields, bool tells);

}  // namespace heightlight
