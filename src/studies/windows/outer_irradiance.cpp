#include "windows/outer_irradiance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/texels.h"
#include "heightlight/solve.h"
#include "window/window_surface.h"

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// A level of the map's heights as a map of its own.
Surface level_surface(const WorkFacts& facts, const HeightPyramid::Level& level, int l) {
  Heightmap map{.height = level.mean,
                .spacing = {std::ldexp(facts.spacing.x, l), std::ldexp(facts.spacing.y, l)},
                .boundary = facts.boundary};
  for (float& height : map.height.values) {
    if (height == kNoHeight) height = kMissing;
  }
  return build_surface(std::move(map));
}

/// A window's field, and nothing around it.
class Patch : public StoredMap {
 public:
  Patch(const Map& field, const WindowPlace& place) : field_(field), place_(place) {}
  int width() const override { return place_.map_width; }
  int height() const override { return place_.map_height; }
  void read(const MapRect& rect, float* samples) const override {
    for (int row = rect.first_row; row < rect.first_row + rect.rows; ++row) {
      for (int column = rect.first_column; column < rect.first_column + rect.columns; ++column) {
        const int i = row - place_.first_row;
        const int j = column - place_.first_column;
        const bool inside = i >= 0 && j >= 0 && i < place_.height && j < place_.width;
        *samples++ = inside ? field_(i, j) : kMissing;
      }
    }
  }

 private:
  const Map& field_;
  WindowPlace place_;
};

}  // namespace

OuterIrradiance find_outer_irradiance(const Work& work, double albedo) {
  constexpr std::size_t kMostBlocks = 1 << 20;
  constexpr double kError = 0.004;
  const CoarseHeights& coarse = *work.coarse;
  std::size_t k = 0;
  while (coarse.levels[k].mean.size() > kMostBlocks) ++k;
  const int level = coarse.first + static_cast<int>(k);
  const Surface surface = level_surface(work.state.facts, coarse.levels[k], level);
  const Results found = solve(surface, {.wanted = {.totals = {{.constant = {albedo}}}},
                                        .accuracy = {.error = std::max(kError, work.task.options.error)},
                                        .checks = {.totals = false},
                                        .watch = work.task.options.watch});
  const Map total = to_map(found.totals[0][0], surface);
  OuterIrradiance outer{.albedo = albedo,
                        .level = coarse.first,
                        .irradiance = Map(coarse.levels[0].mean.width, coarse.levels[0].mean.height)};
  for (int row = 0; row < outer.irradiance.height; ++row) {
    for (int column = 0; column < outer.irradiance.width; ++column)
      outer.irradiance(row, column) = total(row >> k, column >> k);
  }
  return outer;
}

void fill_with_outer_irradiance(const OuterIrradiance& outer, const Surface& window, const GatherField& field,
                                FieldPyramid& pyramid) {
  const WindowPlace place = place_in_map(window);
  const double kept = field.course.kept;
  Map radiosity(place.width, place.height);
  for_texels(radiosity, [&](std::size_t i) {
    radiosity.values[i] =
        new_radiosity(field.albedo(i), field.irradiance.values[i], field.before.values[i], kept);
  });
  Map blocks(outer.irradiance.width, outer.irradiance.height);
  for_texels(blocks, [&](std::size_t i) {
    const float light = outer.irradiance.values[i];
    blocks.values[i] = new_radiosity(outer.albedo, light, light, kept);
  });
  const Map own = coarse_field_of(radiosity, outer.level);
  for (int row = 0; row < own.height; ++row)
    std::copy_n(&own(row, 0), own.width,
                &blocks((place.first_row >> outer.level) + row, place.first_column >> outer.level));
  fill_window_field(window, Patch(radiosity, place), complete_field(outer.level, std::move(blocks)), pyramid);
}

}  // namespace heightlight
