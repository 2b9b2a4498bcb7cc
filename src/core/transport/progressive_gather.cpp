#include "transport/progressive_gather.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "base/texels.h"
#include "heightlight/forms.h"
#include "transport/gather_field.h"
#include "transport/seen_places.h"

namespace heightlight {
namespace {

/// Standard deviation of a field over what is seen: every place has its area times 1 − A as weight.
template <class Value>
double seen_spread(const Map& sky, const Surface& surface, Value&& value) {
  double weights = 0;
  double sum = 0;
  double squares = 0;
  for_seen_places(sky, surface, [&](std::size_t i, double share, double area) {
    const double x = value(i);
    weights += share * area;
    sum += share * area * x;
    squares += share * area * x * x;
  });
  return weights > 0 ? std::sqrt(std::max(0.0, squares - sum * sum / weights) / weights) : 0;
}

double highest_albedo(const IrradianceSystem& system) {
  if (!system.varying) return system.albedo;
  return *std::max_element(system.varying->begin(), system.varying->end());
}

/// Unevenness of the system, which starts with the irradiance `start`.
double unevenness_of(const IrradianceSystem& system, const Map& start, const Map& sky,
                     const Surface& surface) {
  const double even = seen_spread(sky, surface, [&](std::size_t i) {
    return kPlanAlbedo * guess_total(double{sky.values[i]}, kPlanAlbedo);
  });
  const double spread = seen_spread(sky, surface, [&](std::size_t i) {
    const double albedo = system.varying ? (*system.varying)[i] : system.albedo;
    return albedo * double{start.values[i]};
  });
  return even > 0 ? spread / even : 1;
}

/// Makes the pyramid that the next gather of a field reads.
FieldPyramid radiosity_pyramid(const MapGather& gather, const GatherField& field) {
  Map values(field.irradiance.width, field.irradiance.height);
  for_texels(values, [&](std::size_t i) {
    values.values[i] =
        new_radiosity(field.albedo(i), field.irradiance.values[i], field.before.values[i], field.course.kept);
  });
  FieldPyramid pyramid = gather.make_pyramid();
  pyramid.fill(values);
  return pyramid;
}

/// Makes one gather of fields that walk the same azimuths, at most kMostFields.
void step_together(int k, const StepGround& ground, double error, const std::vector<GatherField*>& fields) {
  const GatherTurn turn{.azimuths = azimuths_of_gather(fields[0]->course, k), .turn = spread_turn(k + 1)};
  std::vector<FieldPyramid> pyramids;
  std::vector<const FieldPyramid*> read;
  for (GatherField* field : fields) {
    begin_gather(k, field->course);
    pyramids.push_back(radiosity_pyramid(ground.gather, *field));
  }
  for (const FieldPyramid& pyramid : pyramids) read.push_back(&pyramid);
  const std::vector<ChangeSum> changes = take_step(ground, turn, read, fields, k < kTellingGathers);
  for (std::size_t f = 0; f < changes.size(); ++f)
    end_gather(k, changes[f], !fields[f]->system.direct, error, fields[f]->course);
}

TexelVector take_irradiance(const GatherField& field) {
  TexelVector irradiance(field.irradiance.size());
  for_texels(field.irradiance, [&](std::size_t i) {
    const float value = field.irradiance.values[i];
    irradiance[i] = std::isnan(value) ? 0 : field.unit * double{value};
  });
  return irradiance;
}

}  // namespace

double guess_total(double sky, double albedo) {
  const SkyViewFactor<double> share(sky);
  return bounced_total(share, guess_seen(share), albedo);
}

double unevenness(const IrradianceSystem& system, const Map& sky, const Surface& surface) {
  return unevenness_of(system, start_field(system, sky).irradiance, sky, surface);
}

int azimuths_for_unevenness(double found, const ProgressiveGoal& goal) {
  constexpr double kOrder = 0.75;  // the error of K azimuths falls about as K^−0.75
  constexpr double kMost = 16;
  const double more = found / goal.planned_unevenness;
  if (!(more > 1)) return goal.last_azimuths;
  return even_azimuths(static_cast<int>(goal.last_azimuths * std::min(std::pow(more, 1 / kOrder), kMost)));
}

ProgressiveSolution gather_progressively(const MapGather& gather, const Map& sky,
                                         const std::vector<IrradianceSystem>& systems,
                                         const ProgressiveGoal& goal, const Watch& watch) {
  assert(goal.error > 0);
  Progress progress("bounces", 0, watch);
  const Surface& surface = gather.surface();
  const double deep_share = deep_surface_share(sky, surface);
  std::vector<GatherField> fields;
  for (const IrradianceSystem& system : systems) {
    GatherField& field = fields.emplace_back(start_field(system, sky));
    const double found = unevenness_of(system, field.irradiance, sky, surface);
    field.course = begin_course(highest_albedo(system), deep_share, azimuths_for_unevenness(found, goal));
  }
  const SkyClasses classes(surface, sky.values, kSkyClassesSeed);
  const StepGround ground{gather, sky, classes, watch};
  ProgressiveSolution solution;
  for (int k = 0; k < kMostGathers; ++k) {
    std::map<int, std::vector<GatherField*>> by_azimuths;
    for (GatherField& field : fields) {
      const int azimuths = azimuths_of_gather(field.course, k);
      if (azimuths > 0) by_azimuths[azimuths].push_back(&field);
    }
    if (by_azimuths.empty()) break;
    for (const auto& [azimuths, group] : by_azimuths) {
      for (std::size_t first = 0; first < group.size(); first += kMostFields) {
        const auto begin_of_some = group.begin() + static_cast<std::ptrdiff_t>(first);
        const std::size_t count = std::min(kMostFields, group.size() - first);
        step_together(k, ground, goal.error,
                      {begin_of_some, begin_of_some + static_cast<std::ptrdiff_t>(count)});
      }
    }
    solution.gathers = k + 1;
    progress.add(1);
  }
  for (const GatherField& field : fields) solution.irradiance.push_back(take_irradiance(field));
  return solution;
}

}  // namespace heightlight
