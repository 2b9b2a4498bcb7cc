#pragma once

#include <vector>

#include "transport/gather_course.h"
#include "transport/map_gather.h"

namespace heightlight {

/// One system on its way: all that its receivers know.
struct GatherField {
  const IrradianceSystem& system;
  GatherCourse course = {};
  double unit = 1;      ///< of its direct irradiance
  Map irradiance = {};  ///< E_k/π in units; NaN where the sample is missing
  Map before = {};      ///< E_{k−1}
  Map weighted = {};    ///< N and W
  Map weights = {};

  double albedo(std::size_t i) const { return system.varying ? (*system.varying)[i] : system.albedo; }
  /// E₀/π in units, of a receiver with the sky's share A.
  double direct(std::size_t i, double sky) const { return system.direct ? (*system.direct)[i] / unit : sky; }
};

/// At the start: a closed form under the sky, irradiance of one's own before it bounces.
GatherField start_field(const IrradianceSystem& system, const Map& sky);

/// ρ (E_k − kept E_{k−1})/π: what the gather to come looks at.
inline float new_radiosity(double albedo, float irradiance, float before, double kept) {
  return static_cast<float>(albedo) * (irradiance - static_cast<float>(kept) * before);
}

/// What steps are taken on: the receivers of a surface, or of a window of it.
struct StepGround {
  const MapGather& gather;
  const Map& sky;  ///< A
  const SkyClasses& classes;
  const Watch& watch;
};

/// Gathers the new radiosity of several fields, and takes one step of each. `turn.sky` is not used. Returns
/// what it would change, by fields; nothing where nobody wants to know.
std::vector<ChangeSum> take_step(const StepGround& ground, GatherTurn turn,
                                 const std::vector<const FieldPyramid*>& radiosity,
                                 const std::vector<GatherField*>& fields, bool tells);

}  // namespace heightlight
