#include "transport/progressive_gather.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "base/texel_algebra.h"
#include "base/texels.h"
#include "heightlight/forms.h"
#include "transport/seen_places.h"
#include "transport/sky_classes.h"

namespace heightlight {
namespace {

constexpr int kFewestGathers = 2;
constexpr int kMostGathers = 64;

/// The first gather tells of what is wrong with the start, the second of what lives longer.
constexpr int kTellingGathers = 2;

/// Share of the error wanted that ending the gathers may take: less where one more, of few azimuths, costs
/// little beside the last ones.
constexpr double ending_share(int last_azimuths) { return last_azimuths < 12 ? 0.6 : 0.4; }

/// What is left after a gather, as a share of what the means over classes tell: on bricks, cobbles and
/// fractal ground at reliefs from .1 to 1, at most.
constexpr double kBeyondClasses = 1.5;

/// One system on its way.
struct Field {
  const LightSystem& system;
  double kappa = 0;
  int last_azimuths = 2;
  double weight = 1;  ///< w of the step to come
  int gathers = kMostGathers;
  Map irradiance = {};
  Map before = {};    ///< E_{k−1}
  Map weighted = {};  ///< N and W
  Map weights = {};
  double azimuths = 0;  ///< in N and W, as they weigh there
  double kept = 0;      ///< share of N and W that the gather to come keeps

  double unit = 1;  ///< of its light

  double albedo(std::size_t i) const { return system.varying ? (*system.varying)[i] : system.albedo; }
  /// E₀/π in units, of a receiver with the sky's share A.
  double direct(std::size_t i, double sky) const { return system.direct ? (*system.direct)[i] / unit : sky; }
};

/// Mean over receivers of 1 − A, weighted by its fourth power and area.
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

/// Standard deviation of a field over what is seen: every place weighs its area times 1 − A.
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

double highest_albedo(const LightSystem& system) {
  if (!system.varying) return system.albedo;
  return *std::max_element(system.varying->begin(), system.varying->end());
}

/// Under the sky the closed form G with n guessed from A; light of one's own, in units, before it bounces.
Map start(const LightSystem& system, const Map& sky, double unit) {
  Map irradiance(sky.width, sky.height);
  for_texels(sky, [&](std::size_t i) {
    const double albedo = system.varying ? (*system.varying)[i] : system.albedo;
    const bool missing = std::isnan(sky.values[i]);
    irradiance.values[i] = missing         ? sky.values[i]
                           : system.direct ? static_cast<float>((*system.direct)[i] / unit)
                                           : static_cast<float>(guess_total(double{sky.values[i]}, albedo));
  });
  return irradiance;
}

/// Of `light`, which the system starts with.
double unevenness_of(const LightSystem& system, const Map& light, const Map& sky, const Surface& surface) {
  const double even = seen_spread(sky, surface, [&](std::size_t i) {
    return kPlanAlbedo * guess_total(double{sky.values[i]}, kPlanAlbedo);
  });
  const double spread = seen_spread(sky, surface, [&](std::size_t i) {
    const double albedo = system.varying ? (*system.varying)[i] : system.albedo;
    return albedo * double{light.values[i]};
  });
  return even > 0 ? spread / even : 1;
}

double light_unit(const LightSystem& system) { return system.direct ? unit_of(*system.direct) : 1; }

Field begin(const LightSystem& system, const Map& sky, double deep_share) {
  Field field{.system = system};
  field.kappa = highest_albedo(system) * deep_share;
  field.unit = light_unit(system);
  field.irradiance = start(system, sky, field.unit);
  field.before = field.irradiance;
  field.weighted = Map(sky.width, sky.height);
  field.weights = Map(sky.width, sky.height);
  return field;
}

/// Azimuths for a field that is so much more uneven than the one that they are planned for.
int azimuths_for(double unevenness, int planned) {
  constexpr double kOrder = 0.75;  // what K azimuths leave falls about as K^−0.75
  constexpr double kMost = 16;
  if (!(unevenness > 1)) return planned;
  return even_azimuths(static_cast<int>(planned * std::min(std::pow(unevenness, 1 / kOrder), kMost)));
}

/// How many gathers in all leave no more than the error, when `change` is what the last of `done` would
/// change by itself: no eigenvalue keeps more than κ, and each gather takes off what Chebyshev's weights do.
/// Where the last one was meant to be the last, it may be.
int plan_gathers(const Field& field, double change, double error, int done) {
  const double kappa = field.kappa;
  const double rate = kappa > 0 ? (1 - std::sqrt(1 - std::min(kappa * kappa, 0.9999))) / kappa : 0;
  const double left = change / (1 - std::min(kappa, 0.9999));
  const int fewest = std::max(field.gathers == done ? done : done + 1, kFewestGathers);
  if (!(left > error) || !(rate > 0)) return fewest;
  const int more = static_cast<int>(std::ceil(std::log(error / left) / std::log(rate)));
  return std::clamp(done + more, fewest, kMostGathers);
}

void next_weight(int k, Field& field) {
  const double squared = field.kappa * field.kappa;
  field.weight = k == 0 || k + 1 == field.gathers ? 1
                 : k == 1                         ? 1 / (1 - squared / 2)
                                                  : 1 / (1 - squared * field.weight / 4);
}

/// What a gather would change with a weight of 1, summed over receivers.
struct Change {
  double squares = 0;
  SkyClasses::PerClass<double> sum{};
  SkyClasses::PerClass<std::size_t> receivers{};

  void add(double change, std::size_t sky_class) {
    squares += change * change;
    sum[sky_class] += change;
    ++receivers[sky_class];
  }
  void add(const Change& other) {
    squares += other.squares;
    for (std::size_t k = 0; k < sum.size(); ++k) {
      sum[k] += other.sum[k];
      receivers[k] += other.receivers[k];
    }
  }
};

/// RMS of what is wrong but for noise: under the sky, of the means over the classes. Light of one's own may
/// be anywhere.
double lasting_change(const Change& change, const LightSystem& system) {
  double squares = 0;
  double count = 0;
  for (std::size_t k = 0; k < change.sum.size(); ++k) {
    const auto receivers = static_cast<double>(change.receivers[k]);
    count += receivers;
    if (receivers > 0) squares += change.sum[k] * change.sum[k] / receivers;
  }
  if (!(count > 0)) return 0;
  return system.direct ? std::sqrt(change.squares / count) : kBeyondClasses * std::sqrt(squares / count);
}

/// One gather's step of several fields, and what it changes of each.
class GatherStep {
 public:
  GatherStep(const MapGather& gather, const Map& sky, const Watch& watch)
      : gather_(gather), sky_(sky), watch_(watch), classes_(gather.surface(), sky.values, kClassesSeed) {}

  /// `tells`: whether anyone wants to know what changes.
  std::vector<Change> take(const GatherTurn& turn, const std::vector<Field*>& fields, bool tells) {
    std::vector<FieldPyramid> pyramids;
    std::vector<const FieldPyramid*> read;
    for (Field* field : fields) {
      const double walked = kFading * field->azimuths;
      field->azimuths = walked + turn.azimuths;
      field->kept = walked / field->azimuths;
      pyramids.push_back(new_radiosity(*field));
    }
    for (const FieldPyramid& pyramid : pyramids) read.push_back(&pyramid);
    const TileGrid grid(sky_.width, sky_.height);
    const auto tiles = static_cast<std::size_t>(grid.count());
    std::vector<Change> parts(tiles * fields.size());
    gather_.run(
        turn, read,
        [&](const ReceiverTile& tile, const GatherSums& sums) {
          const auto index = static_cast<std::size_t>(tile.first_row / TileFrame::kSide * grid.across +
                                                      tile.first_column / TileFrame::kSide);
          for (std::size_t f = 0; f < fields.size(); ++f)
            update(tile, sums.weight, sums.weighted[f], *fields[f],
                   tells ? &parts[f * tiles + index] : nullptr);
        },
        watch_);
    std::vector<Change> changes(fields.size());
    for (std::size_t f = 0; f < fields.size(); ++f) {
      for (std::size_t i = 0; i < tiles; ++i) changes[f].add(parts[f * tiles + i]);
    }
    return changes;
  }

 private:
  static constexpr std::uint64_t kClassesSeed = 1;

  /// ρ (E_k − kept E_{k−1})
  FieldPyramid new_radiosity(const Field& field) const {
    Map values(sky_.width, sky_.height);
    const auto kept = static_cast<float>(field.kept);
    for_texels(sky_, [&](std::size_t i) {
      const float light = field.irradiance.values[i] - kept * field.before.values[i];
      values.values[i] = static_cast<float>(field.albedo(i)) * light;
    });
    FieldPyramid pyramid = gather_.make_pyramid();
    pyramid.fill(values);
    return pyramid;
  }

  void update(const ReceiverTile& tile, const GatherSums::Values& weight, const GatherSums::Values& weighted,
              Field& field, Change* change) const {
    const auto kept = static_cast<float>(field.kept);
    for_present(tile, [&](std::size_t at, int row, int column) {
      const std::size_t i = sky_.index(row, column);
      float& sum = field.weighted.values[i];
      float& all = field.weights.values[i];
      sum = weighted[at] + kept * sum;
      all = (1 - kept) * weight[at] + kept * all;
      float& now = field.irradiance.values[i];
      float& before = field.before.values[i];
      // Who sees nothing along all azimuths so far, but has A < 1, sees its like.
      const double seen = all > 0 ? double{sum} / double{all} : field.albedo(i) * double{now};
      const double share = double{sky_.values[i]};
      const double next = field.direct(i, share) + (1 - share) * seen;
      if (change) change->add(next - double{now}, classes_.of(share));
      const double stepped = double{before} + field.weight * (next - double{before});
      before = now;
      now = static_cast<float>(std::max(stepped, 0.0));
    });
  }

  const MapGather& gather_;
  const Map& sky_;
  const Watch& watch_;
  SkyClasses classes_;
};

TexelVector take_irradiance(const Field& field) {
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

double unevenness(const LightSystem& system, const Map& sky, const Surface& surface) {
  return unevenness_of(system, start(system, sky, light_unit(system)), sky, surface);
}

int gather_azimuths(int left, int last_azimuths) {
  constexpr int kFewest = 4;
  const int part = left <= 2 ? 1 : left == 3 ? 2 : 4;
  return even_azimuths(std::max(last_azimuths / part, std::min(last_azimuths, kFewest)));
}

ProgressiveSolution gather_progressively(const MapGather& gather, const Map& sky,
                                         const std::vector<LightSystem>& systems, const ProgressiveGoal& goal,
                                         const Watch& watch) {
  assert(goal.error > 0);
  Progress progress("bounces", 0, watch);
  const double deep_share = deep_surface_share(sky, gather.surface());
  std::vector<Field> fields;
  const Surface& surface = gather.surface();
  for (const LightSystem& system : systems) {
    Field& field = fields.emplace_back(begin(system, sky, deep_share));
    const double found = unevenness_of(system, field.irradiance, sky, surface);
    field.last_azimuths = azimuths_for(found / goal.planned_unevenness, goal.last_azimuths);
  }
  ProgressiveSolution solution;
  GatherStep step(gather, sky, watch);
  for (int k = 0; k < kMostGathers; ++k) {
    std::map<int, std::vector<Field*>> by_azimuths;
    for (Field& field : fields) {
      const int left = field.gathers - k;
      if (left > 0) by_azimuths[gather_azimuths(left, field.last_azimuths)].push_back(&field);
    }
    if (by_azimuths.empty()) break;
    for (const auto& [azimuths, group] : by_azimuths) {
      const GatherTurn turn{.azimuths = azimuths, .turn = spread_turn(k + 1), .sky = &sky};
      for (std::size_t first = 0; first < group.size(); first += kMostFields) {
        const auto begin_of_some = group.begin() + static_cast<std::ptrdiff_t>(first);
        const std::size_t count = std::min(kMostFields, group.size() - first);
        const std::vector<Field*> some(begin_of_some, begin_of_some + static_cast<std::ptrdiff_t>(count));
        for (Field* field : some) next_weight(k, *field);
        const std::vector<Change> changes = step.take(turn, some, k < kTellingGathers);
        for (std::size_t f = 0; k < kTellingGathers && f < count; ++f) {
          const double change = lasting_change(changes[f], some[f]->system);
          some[f]->gathers =
              plan_gathers(*some[f], change, ending_share(some[f]->last_azimuths) * goal.error, k + 1);
        }
      }
    }
    solution.gathers = k + 1;
    progress.add(1);
  }
  for (const Field& field : fields) solution.irradiance.push_back(take_irradiance(field));
  return solution;
}

}  // namespace heightlight
