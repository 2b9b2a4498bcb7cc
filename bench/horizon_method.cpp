#include "horizon_method.h"

#include <cmath>
#include <string>

#include "heightlight/transport.h"
#include "transport/horizon_plan.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

constexpr std::uint64_t kSeed = 1;  // of the calibration sample; differs from the reference's seeds

Map walk_sky(const Surface& surface, const SkyPlan& plan) {
  return walk_horizon_sky(surface, build_height_pyramid(surface), plan).sky_view_factor;
}

/// A walk with given azimuths and samples per octave. Where 1 − A is less than `full_from`, it takes only
/// every other azimuth.
Method walk_method(const Surface& surface, int samples_per_octave, double full_from) {
  Method method;
  method.name =
      "horizon walk, fineness " + std::to_string(samples_per_octave) + (full_from > 0 ? ", sparse" : "");
  method.parameter = "azimuths";
  method.settings = {4, 8, 12, 16, 24, 32, 48, 64, 96, 128};
  method.granularity = 4;
  method.run_map = [&surface, samples_per_octave, full_from](int azimuths) {
    return walk_sky(surface, {.walk = {.azimuths = azimuths, .samples_per_octave = samples_per_octave},
                              .full_from = full_from});
  };
  return method;
}

/// A method that plans for an error; its setting is 1/error.
Method planned_method(const std::vector<double>& errors) {
  Method method;
  method.name = "horizon walk, planned";
  method.parameter = "1/error";
  method.setting_for = [](double error) { return static_cast<int>(std::lround(1 / error)); };
  for (const double error : errors) method.settings.push_back(method.setting_for(error));
  return method;
}

Method planned_sky_method(const Surface& surface) {
  Method method = planned_method({0.016, 0.011, 0.008, 0.0056, 0.004, 0.0028, 0.002, 0.0014, 0.001, 0.0007});
  method.run_map = [&surface](int inverse) {
    HorizonGoal goal;
    goal.error = 1.0 / inverse;
    const Watch unwatched;
    const HeightPyramid pyramid = build_height_pyramid(surface);
    SkyCalibration calibration(surface, pyramid, {.seed = kSeed, .watch = unwatched});
    return walk_sky(surface, plan_sky(calibration, goal));
  };
  return method;
}

}  // namespace

std::vector<Method> horizon_sky_methods(const Surface& surface) {
  std::vector<Method> methods;
  constexpr double kFullFrom = 0.3;  // such places are beside walls; on brick, a third of the map
  for (const int samples_per_octave : {8, 12, 16, 20, 24, 32})
    methods.push_back(walk_method(surface, samples_per_octave, 0));
  for (const int samples_per_octave : {12, 16, 20, 24})
    methods.push_back(walk_method(surface, samples_per_octave, kFullFrom));
  methods.push_back(planned_sky_method(surface));
  return methods;
}

Method horizon_total_method(const Surface& surface, double albedo) {
  Method method = planned_method({0.02, 0.014, 0.01, 0.007, 0.005, 0.0035, 0.0025});
  method.run_map = [&surface, albedo](int inverse) {
    HorizonGoal goal;
    goal.error = 1.0 / inverse;
    const PlannedTransport planned = plan_horizon_transport(surface, goal);
    return to_map(planned.transport->solve({{.albedo = albedo}}, {}).irradiance[0], surface);
  };
  return method;
}

}  // namespace heightlight
