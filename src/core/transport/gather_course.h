#pragma once

#include <cstdint>

#include "base/fixed_sum.h"
#include "heightlight/surface.h"
#include "heightlight/transport.h"
#include "transport/sky_classes.h"

// How the gathers of one system follow on each other (progressive_gather.h): numbers that are the same for
// all receivers, wherever those are kept.

namespace heightlight {

/// λ of the azimuths walked before, by what they are together: what the steps between gathers bring is known
/// from few azimuths. (On bricks 0.3 is as good, 1 half as good again.)
constexpr double kFading = 0.6;

constexpr int kMostGathers = 64;

/// The first gather tells of what is wrong with the start, the second of what lives longer.
constexpr int kTellingGathers = 2;

/// What a gather would change with a weight of 1, summed over some receivers.
struct Change {
  double squares = 0;
  SkyClasses::PerClass<double> sum{};
  SkyClasses::PerClass<std::uint64_t> receivers{};

  void add(double change, std::size_t sky_class) {
    squares += change * change;
    sum[sky_class] += change;
    ++receivers[sky_class];
  }
};

/// The same over all receivers, tile by tile in any order.
struct ChangeSum {
  FixedSum squares;
  SkyClasses::PerClass<FixedSum> sum{};
  SkyClasses::PerClass<std::uint64_t> receivers{};

  void add(const Change& change);
  void add(const ChangeSum& other);
};

struct GatherCourse {
  double kappa = 0;            ///< κ
  int last_azimuths = 2;       ///< of each of the last two gathers
  double weight = 1;           ///< w of the step to come
  int gathers = kMostGathers;  ///< in all, as far as known
  double azimuths = 0;         ///< in N and W, as they weigh there
  double kept = 0;             ///< share of N and W that the gather to come keeps
};

/// κ of a system that has no larger albedo. `deep_share` is 1 − A of the places that see most of the surface,
/// as below.
GatherCourse begin_course(double highest_albedo, double deep_share, int last_azimuths);

/// Mean over receivers of 1 − A, weighted by its fourth power and area.
double deep_surface_share(const Map& sky, const Surface& surface);

/// Azimuths of a gather when so many are left, itself among them.
int gather_azimuths(int left, int last_azimuths);

/// Azimuths of the k-th gather, k = 0, 1 …; 0 where the course has ended.
int azimuths_of_gather(const GatherCourse& course, int k);

/// Sets what the k-th gather steps and keeps.
void begin_gather(int k, GatherCourse& course);

/// Plans how many gathers there are to be, from what the k-th, one of the first kTellingGathers, changed of
/// the system, so that ending leaves its share of the error.
void end_gather(int k, const ChangeSum& change, bool under_sky, double error, GatherCourse& course);

}  // namespace heightlight
