#include "transport/gather_field.h"

#include <algorithm>
#include <cmath>

#include "base/texel_algebra.h"
#include "base/texels.h"
#include "transport/progressive_gather.h"

namespace heightlight {
namespace {

/// Takes one step of the receivers of a tile. `change` may be null.
void update(const ReceiverTile& tile, const GatherSums& sums, std::size_t f, const StepGround& ground,
            GatherField& field, Change* change) {
  const GatherSums::Values& weight = sums.weight;
  const GatherSums::Values& weighted = sums.weighted[f];
  const auto kept = static_cast<float>(field.course.kept);
  for_present(tile, [&](std::size_t at, int row, int column) {
    const std::size_t i = ground.sky.index(row, column);
    float& sum = field.weighted.values[i];
    float& all = field.weights.values[i];
    sum = weighted[at] + kept * sum;
    all = (1 - kept) * weight[at] + kept * all;
    float& now = field.irradiance.values[i];
    float& before = field.before.values[i];
    // A receiver that sees nothing along all azimuths so far, but has A < 1, is taken to see its own
    // radiosity.
    const double seen = all > 0 ? double{sum} / double{all} : field.albedo(i) * double{now};
    const double share = double{ground.sky.values[i]};
    const double next = field.direct(i, share) + (1 - share) * seen;
    if (change) change->add(next - double{now}, ground.classes.of(share));
    const double stepped = double{before} + field.course.weight * (next - double{before});
    before = now;
    now = static_cast<float>(std::max(stepped, 0.0));
  });
}

}  // namespace

GatherField start_field(const IrradianceSystem& system, const Map& sky) {
  GatherField field{.system = system};
  if (system.direct) field.unit = unit_of(*system.direct);
  field.irradiance = Map(sky.width, sky.height);
  for_texels(sky, [&](std::size_t i) {
    const float share = sky.values[i];
    field.irradiance.values[i] = std::isnan(share) ? share
                                 : system.direct
                                     ? static_cast<float>(field.direct(i, double{share}))
                                     : static_cast<float>(guess_total(double{share}, field.albedo(i)));
  });
  field.before = field.irradiance;
  field.weighted = Map(sky.width, sky.height);
  field.weights = Map(sky.width, sky.height);
  return field;
}

std::vector<ChangeSum> take_step(const StepGround& ground, GatherTurn turn,
                                 const std::vector<const FieldPyramid*>& radiosity,
                                 const std::vector<GatherField*>& fields, bool tells) {
  turn.sky = &ground.sky;
  const TileGrid grid(ground.sky.width, ground.sky.height);
  const auto tiles = static_cast<std::size_t>(grid.count());
  std::vector<Change> parts(tells ? tiles * fields.size() : 0);
  ground.gather.run(
      turn, radiosity,
      [&](const ReceiverTile& tile, const GatherSums& sums) {
        const auto index = static_cast<std::size_t>(tile.first_row / TileFrame::kSide * grid.across +
                                                    tile.first_column / TileFrame::kSide);
        for (std::size_t f = 0; f < fields.size(); ++f)
          update(tile, sums, f, ground, *fields[f], tells ? &parts[f * tiles + index] : nullptr);
      },
      ground.watch);
  std::vector<ChangeSum> changes(tells ? fields.size() : 0);
  for (std::size_t f = 0; f < changes.size(); ++f) {
    for (std::size_t i = 0; i < tiles; ++i) changes[f].add(parts[f * tiles + i]);
  }
  return changes;
}

}  // namespace heightlight
