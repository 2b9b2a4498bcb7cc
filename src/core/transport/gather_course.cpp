#include "transport/gather_course.h"

#include <algorithm>
#include <cmath>

#include "transport/map_gather.h"
#include "transport/seen_places.h"

namespace heightlight {
namespace {

constexpr int kFewestGathers = 2;

/// Share of the error wanted that ending the gathers may take. It is less where the last gathers walk many
/// azimuths, since one more gather of few azimuths then costs little beside them.
constexpr double ending_share(int last_azimuths) { return last_azimuths < 12 ? 0.6 : 0.4; }

/// The error left after a gather is at most this many times what the class means show, on bricks, cobbles and
/// fractal ground at reliefs from .1 to 1.
constexpr double kBeyondClasses = 1.5;

/// RMS of the error without its noise. Under the sky the class means show it. A user-given light may be
/// anywhere, so there all changes count.
double lasting_change(const ChangeSum& change, bool under_sky) {
  double squares = 0;
  double count = 0;
  for (std::size_t k = 0; k < change.sum.size(); ++k) {
    const auto receivers = static_cast<double>(change.receivers[k]);
    const double sum = change.sum[k].value();
    count += receivers;
    if (receivers > 0) squares += sum * sum / receivers;
  }
  if (!(count > 0)) return 0;
  return under_sky ? kBeyondClasses * std::sqrt(squares / count) : std::sqrt(change.squares.value() / count);
}

/// Number of gathers in all that leaves no more than the error, where `change` is what the last of `done`
/// gathers would change with a step weight of 1. No eigenvalue exceeds κ, and each further gather shrinks the
/// error at the rate that Chebyshev's weights give. The last gather may remain the last if it was meant to
/// be.
int plan_gathers(const GatherCourse& course, double change, double error, int done) {
  const double kappa = course.kappa;
  const double rate = kappa > 0 ? (1 - std::sqrt(1 - std::min(kappa * kappa, 0.9999))) / kappa : 0;
  const double left = change / (1 - std::min(kappa, 0.9999));
  const int fewest = std::max(course.gathers == done ? done : done + 1, kFewestGathers);
  if (!(left > error) || !(rate > 0)) return fewest;
  const int more = static_cast<int>(std::ceil(std::log(error / left) / std::log(rate)));
  return std::clamp(done + more, fewest, kMostGathers);
}

}  // namespace

void ChangeSum::add(const Change& change) {
  squares.add(change.squares);
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k].add(change.sum[k]);
    receivers[k] += change.receivers[k];
  }
}

void ChangeSum::add(const ChangeSum& other) {
  squares.add(other.squares);
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k].add(other.sum[k]);
    receivers[k] += other.receivers[k];
  }
}

GatherCourse begin_course(double highest_albedo, double deep_share, int last_azimuths) {
  return {.kappa = highest_albedo * deep_share, .last_azimuths = last_azimuths};
}

double deep_surface_share(const Map& sky, const Surface& surface) {
  double sum = 0;
  double weights = 0;
  for_seen_places(sky, surface, [&](std::size_t, double share, double area) {
    const double weight = share * share * share * share * area;
    sum += weight * share;
    weights += weight;
  });
  return weights > 0 ? sum / weights : 0;
}

int gather_azimuths(int left, int last_azimuths) {
  constexpr int kFewest = 4;
  const int part = left <= 2 ? 1 : left == 3 ? 2 : 4;
  return even_azimuths(std::max(last_azimuths / part, std::min(last_azimuths, kFewest)));
}

int azimuths_of_gather(const GatherCourse& course, int k) {
  return k < course.gathers ? gather_azimuths(course.gathers - k, course.last_azimuths) : 0;
}

void begin_gather(int k, GatherCourse& course) {
  const double squared = course.kappa * course.kappa;
  course.weight = k == 0 || k + 1 == course.gathers ? 1
                  : k == 1                          ? 1 / (1 - squared / 2)
                                                    : 1 / (1 - squared * course.weight / 4);
  const double walked = kFading * course.azimuths;
  course.azimuths = walked + azimuths_of_gather(course, k);
  course.kept = walked / course.azimuths;
}

void end_gather(int k, const ChangeSum& change, bool under_sky, double error, GatherCourse& course) {
  const double left = lasting_change(change, under_sky);
  course.gathers = plan_gathers(course, left, ending_share(course.last_azimuths) * error, k + 1);
}

}  // namespace heightlight
