#pragma once

#include <cstdint>

#include "base/fixed_sum.h"
#include "heightlight/surface.h"
#include "heightlight/transport.h"
#include "transport/sky_classes.h"

// How the gathers of one system follow each other (progressive_gather.h): numbers that are the same for all
// receivers, wherever the receivers are kept.

namespace heightlight {

/// At every gather the weight of the azimuths walked before fades by this factor, since the changes between
/// gathers are known from few azimuths. (On bricks 0.3 is as good; 1 errs half as much again.)
constexpr double kFading = 0.6;

constexpr int kMostGathers = 64;

/// Gathers from which their number is planned: the first shows the error of the start, the second the part of
/// it that persists longer.
constexpr int kTellingGathers = 2;

/// What a gather would change with a step weight of 1, summed over some receivers.
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

/// The same over all receivers; tiles may be added in any order.
struct ChangeSum {
  FixedSum squares;
  SkyClasses::PerClass<FixedSum> sum{};
  SkyClasses::PerClass<std::uint64_t> receivers{};

  void add(const Change& change);
  void add(const ChangeSum& other);
};

struct GatherCourse {
  double kappa = 0;            ///< κ
  int last_azimuths = 2;       ///< azimuths of each of the last two gathers
  double weight = 1;           ///< w of the next step
  int gathers = kMostGathers;  ///< number of gathers in all, as far as known
  double azimuths = 0;         ///< azimuths in N and W, each with its weight there
  double kept = 0;             ///< share of N and W that the next gather keeps
};

/// Starts the course of a system whose largest albedo is `highest_albedo`: κ is its product with
/// `deep_share`, which is 1 − A of the places that see most of the surface (deep_surface_share).
GatherCourse begin_course(double highest_albedo, double deep_share, int last_azimuths);

/// Mean over receivers of 1 − A, weighted by its fourth power and area.
double deep_surface_share(const Map& sky, const Surface& surface);

/// Azimuths of a gather when `left` gathers are left, itself included.
int gather_azimuths(int left, int last_azimuths);

/// Azimuths of the k-th gather, k = 0, 1 …; 0 where the course has ended.
int azimuths_of_gather(const GatherCourse& course, int k);

/// Sets the weight of the k-th gather's step, and the share of the sums that it keeps.
void begin_gather(int k, GatherCourse& course);

/// Plans the number of gathers so that ending leaves no more than its share of the error. `change` is what
/// the k-th gather, one of the first kTellingGathers, changed of the system.
void end_gather(int k, const ChangeSum& change, bool under_sky, double error, GatherCourse& course);

}  // namespace heightlight
