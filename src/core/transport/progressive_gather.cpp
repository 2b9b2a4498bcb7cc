#include "transport/progressive_gather.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>

#include "base/texels.h"
#include "heightlight/forms.h"

namespace heightlight {
namespace {

constexpr int kFewestGathers = 3;
constexpr int kMostGathers = 64;

/// Share of the error wanted that ending the gathers may take.
constexpr double kEndingShare = 0.5;

/// The weight in the last gather of the sums of the one before, which saw light that is a little more wrong.
constexpr float kKeptShare = 0.9F;

/// One system on its way.
struct Field {
  const LightSystem& system;
  double kappa = 0;
  double weight = 1;  ///< w of the step to come
  int gathers = kMostGathers;
  Map irradiance = {};
  Map before = {};    ///< E_{k−1}
  Map weighted = {};  ///< sums so far, of what was seen, and their weights
  Map weights = {};

  double unit = 1;  ///< of its light: unit_of

  double albedo(std::size_t i) const { return system.varying ? (*system.varying)[i] : system.albedo; }
  /// E₀/π in units, of a receiver with the sky's share A.
  double direct(std::size_t i, double sky) const { return system.direct ? (*system.direct)[i] / unit : sky; }
};

/// Mean over receivers of 1 − A, weighted by its fourth power and area.
double deep_surface_share(const Map& sky, const Surface& surface) {
  double sum = 0;
  double weights = 0;
  for (std::size_t i = 0; i < sky.size(); ++i) {
    const double share = 1 - double{sky.values[i]};
    if (std::isnan(share)) continue;
    const double weight = std::pow(share, 4) / double{surface.normal.values[i].z};
    sum += weight * share;
    weights += weight;
  }
  return weights > 0 ? sum / weights : 0;
}

double highest_albedo(const LightSystem& system) {
  if (!system.varying) return system.albedo;
  return *std::max_element(system.varying->begin(), system.varying->end());
}

/// The largest power of two that the brightest direct light reaches; 1 under the sky.
double unit_of(const LightSystem& system) {
  if (!system.direct) return 1;
  const double brightest = *std::max_element(system.direct->begin(), system.direct->end());
  int exponent = 0;
  std::frexp(brightest, &exponent);
  return brightest > 0 ? std::ldexp(1.0, std::clamp(exponent, -1000, 1000) - 1) : 1;
}

/// Under the sky the closed form G with n guessed from A; light of one's own, in units, before it bounces.
Map start(const LightSystem& system, const Map& sky, double unit) {
  Map irradiance(sky.width, sky.height);
  for_texels(sky, [&](std::size_t i) {
    const double albedo = system.varying ? (*system.varying)[i] : system.albedo;
    const SkyViewFactor<double> share(double{sky.values[i]});
    const bool missing = std::isnan(sky.values[i]);
    irradiance.values[i] = missing ? sky.values[i]
                           : system.direct
                               ? static_cast<float>((*system.direct)[i] / unit)
                               : static_cast<float>(bounced_total(share, guess_seen(share), albedo));
  });
  return irradiance;
}

Field begin(const LightSystem& system, const Map& sky, double deep_share) {
  Field field{.system = system};
  field.kappa = highest_albedo(system) * deep_share;
  field.unit = unit_of(system);
  field.irradiance = start(system, sky, field.unit);
  field.before = field.irradiance;
  field.weighted = Map(sky.width, sky.height);
  field.weights = Map(sky.width, sky.height);
  return field;
}

/// How many gathers leave no more than the error of what the first one changed, RMS.
int plan_gathers(double kappa, double change, double error) {
  const double left = std::sqrt(1 - std::min(kappa * kappa, 0.9999));
  const double rate = kappa > 0 ? (1 - left) / kappa : 0;
  const double first = 2 * change / left;  // of the start, about
  if (!(first > error) || !(rate > 0)) return kFewestGathers;
  const int gathers = 1 + static_cast<int>(std::ceil(std::log(error / first) / std::log(rate)));
  return std::clamp(gathers, kFewestGathers, kMostGathers);
}

void next_weight(int k, Field& field) {
  const double squared = field.kappa * field.kappa;
  field.weight = k == 0 || k + 1 == field.gathers ? 1
                 : k == 1                         ? 1 / (1 - squared / 2)
                                                  : 1 / (1 - squared * field.weight / 4);
}

/// Azimuths of a gather when so many are left, itself among them. What early ones leave of noise falls with
/// all else that is wrong.
int azimuths_of(int left, int last_azimuths) {
  const int part = left <= 2 ? 1 : left == 3 ? 2 : 4;
  return even_azimuths(last_azimuths / part);
}

/// One gather's step of several fields, and the RMS of what it would change, per field, with a weight of 1.
class GatherStep {
 public:
  GatherStep(const MapGather& gather, const Map& sky, float kept, const Watch& watch)
      : gather_(gather), sky_(sky), kept_(kept), watch_(watch) {
    const auto missing =
        std::count_if(sky.values.begin(), sky.values.end(), [](float a) { return std::isnan(a); });
    receivers_ = std::max<std::size_t>(1, sky.size() - static_cast<std::size_t>(missing));
  }

  std::vector<double> take(const GatherTurn& turn, const std::vector<Field*>& fields) {
    std::vector<FieldPyramid> pyramids;
    std::vector<const FieldPyramid*> read;
    for (const Field* field : fields) pyramids.push_back(radiosity(*field));
    for (const FieldPyramid& pyramid : pyramids) read.push_back(&pyramid);
    const TileGrid grid(sky_.width, sky_.height);
    const auto tiles = static_cast<std::size_t>(grid.count());
    std::vector<double> squares(tiles * fields.size());
    gather_.run(
        turn, read,
        [&](const ReceiverTile& tile, const GatherSums& sums) {
          const auto index = static_cast<std::size_t>(tile.first_row / TileFrame::kSide * grid.across +
                                                      tile.first_column / TileFrame::kSide);
          for (std::size_t f = 0; f < fields.size(); ++f)
            squares[f * tiles + index] = update(tile, sums.weight, sums.weighted[f], *fields[f]);
        },
        watch_);
    std::vector<double> changes;
    for (std::size_t f = 0; f < fields.size(); ++f) {
      double sum = 0;
      for (std::size_t i = 0; i < tiles; ++i) sum += squares[f * tiles + i];
      changes.push_back(std::sqrt(sum / static_cast<double>(receivers_)));
    }
    return changes;
  }

 private:
  FieldPyramid radiosity(const Field& field) const {
    Map values(sky_.width, sky_.height);
    for_texels(sky_, [&](std::size_t i) {
      values.values[i] = static_cast<float>(field.albedo(i)) * field.irradiance.values[i];
    });
    FieldPyramid pyramid = gather_.make_pyramid();
    pyramid.fill(values);
    return pyramid;
  }

  double update(const ReceiverTile& tile, const GatherSums::Values& weight,
                const GatherSums::Values& weighted, Field& field) const {
    double squares = 0;
    for (int row = 0; row < tile.rows; ++row) {
      for (int column = 0; column < tile.columns; ++column) {
        const auto at = static_cast<std::size_t>(row * ReceiverTile::kSide + column);
        if (!tile.present[at]) continue;
        const std::size_t i = sky_.index(tile.first_row + row, tile.first_column + column);
        float& sum = field.weighted.values[i];
        float& all = field.weights.values[i];
        sum = weighted[at] + kept_ * sum;
        all = weight[at] + kept_ * all;
        float& now = field.irradiance.values[i];
        float& before = field.before.values[i];
        // Who sees nothing along all azimuths so far, but has A < 1, sees its like.
        const double seen = all > 0 ? double{sum} / double{all} : field.albedo(i) * double{now};
        const double share = double{sky_.values[i]};
        const double next = field.direct(i, share) + (1 - share) * seen;
        squares += (next - double{now}) * (next - double{now});
        const double stepped = double{before} + field.weight * (next - double{before});
        before = now;
        now = static_cast<float>(std::max(stepped, 0.0));
      }
    }
    return squares;
  }

  const MapGather& gather_;
  const Map& sky_;
  float kept_;
  const Watch& watch_;
  std::size_t receivers_;  ///< present, and 1 where none is
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

ProgressiveSolution gather_progressively(const MapGather& gather, const Map& sky,
                                         const std::vector<LightSystem>& systems, const ProgressiveGoal& goal,
                                         const Watch& watch) {
  assert(goal.error > 0);
  Progress progress("bounces", 0, watch);
  const double deep_share = deep_surface_share(sky, gather.surface());
  std::vector<Field> fields;
  for (const LightSystem& system : systems) fields.push_back(begin(system, sky, deep_share));
  ProgressiveSolution solution;
  for (int k = 0; k < kMostGathers; ++k) {
    std::map<int, std::vector<Field*>> by_gathers_left;
    for (Field& field : fields) {
      if (k < field.gathers) by_gathers_left[field.gathers - k].push_back(&field);
    }
    if (by_gathers_left.empty()) break;
    for (const auto& [left, group] : by_gathers_left) {
      const GatherTurn turn{azimuths_of(left, goal.last_azimuths), golden_turn(k + 1), &sky};
      GatherStep step(gather, sky, left == 1 ? kKeptShare : 0, watch);
      for (std::size_t first = 0; first < group.size(); first += kMostFields) {
        const auto begin_of_some = group.begin() + static_cast<std::ptrdiff_t>(first);
        const std::size_t count = std::min(kMostFields, group.size() - first);
        const std::vector<Field*> some(begin_of_some, begin_of_some + static_cast<std::ptrdiff_t>(count));
        for (Field* field : some) next_weight(k, *field);
        const std::vector<double> changes = step.take(turn, some);
        for (std::size_t f = 0; k == 0 && f < count; ++f)
          some[f]->gathers = plan_gathers(some[f]->kappa, changes[f], kEndingShare * goal.error);
      }
    }
    solution.gathers = k + 1;
    progress.add(1);
  }
  for (const Field& field : fields) solution.irradiance.push_back(take_irradiance(field));
  return solution;
}

}  // namespace heightlight
