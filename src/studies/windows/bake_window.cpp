#include "windows/bake_window.h"

#include <algorithm>
#include <cmath>

#include "bake/material.h"
#include "bake/texture_files.h"
#include "base/texels.h"
#include "files/geotiff_place.h"
#include "heightlight/error.h"
#include "transport/gather_field.h"
#include "visibility/horizon_sky.h"
#include "windows/begin_work.h"
#include "windows/outer_irradiance.h"
#include "windows/step_plan.h"
#include "windows/steps.h"
#include "windows/windowed_bake.h"
#include "windows/work_check.h"
#include "windows/work_place.h"

namespace heightlight {
namespace {

/// Aligned to tiles and wider by `halo` on all sides, where the map goes on; the whole extent along an axis
/// on which it would go over the edge of a map that tiles.
WindowPlace widened(const MapRect& window, int halo, const WorkFacts& facts) {
  const auto along = [&](int first, int count, int samples) {
    const int begin = (first - halo) >= 0 ? (first - halo) / kTileSide * kTileSide : first - halo;
    const int end = first + count + halo;
    const int aligned_end = (end + kTileSide - 1) / kTileSide * kTileSide;
    const bool crosses = facts.boundary == Boundary::tile && (begin < 0 || end > samples);
    return crosses ? std::pair(0, samples) : std::pair(std::max(begin, 0), std::min(aligned_end, samples));
  };
  const auto [top, bottom] = along(window.first_row, window.rows, facts.grid.map_height);
  const auto [left, right] = along(window.first_column, window.columns, facts.grid.map_width);
  return {.map_width = facts.grid.map_width,
          .map_height = facts.grid.map_height,
          .first_row = top,
          .first_column = left,
          .width = right - left,
          .height = bottom - top};
}

/// The total of one channel in a window and its halo, with the light of what is around it.
Map solve_window(const Work& work, std::size_t channel, const Surface& surface, const Map& sky) {
  const BakeOptions& options = work.task.options;
  const GatherPlan& plan = work.state.plan->gather;
  const IrradianceSystem system{.albedo = options.albedo.constant[channel]};
  const OuterIrradiance outer = find_outer_irradiance(work, system.albedo);
  const MapGather gather(surface, {}, plan.walk);
  GatherField field = start_field(system, sky);
  field.course = begin_course(system.albedo, deep_surface_share(sky, surface), plan.walk.azimuths);
  std::vector<double> sample;
  for (const std::size_t texel : SkyClasses::sample_receivers(surface, kSkyClassesSeed))
    sample.push_back(double{sky.values[texel]});
  const SkyClasses classes(std::move(sample));
  const StepGround ground{gather, sky, classes, options.watch};
  for (int k = 0; azimuths_of_gather(field.course, k) > 0; ++k) {
    begin_gather(k, field.course);
    FieldPyramid pyramid = gather.make_pyramid();
    fill_with_outer_irradiance(outer, surface, field, pyramid);
    const GatherTurn turn{.azimuths = azimuths_of_gather(field.course, k), .turn = spread_turn(k + 1)};
    const std::vector<ChangeSum> changes = take_step(ground, turn, {&pyramid}, {&field}, k < kTellingGathers);
    if (!changes.empty()) end_gather(k, changes[0], true, options.error, field.course);
  }
  return field.irradiance;
}

/// What the window's textures are made of: maps of the window and its halo.
Material material_of(const Work& work, const Surface& surface) {
  const BakeOptions& options = work.task.options;
  const SkyPlan& plan = work.state.plan->sky;
  const Request request = material_request(options, azimuth_convention(options, surface.map.boundary));
  HorizonSky sky = walk_horizon_sky(surface, {}, plan,
                                    {.wanted = request.wanted.moments,
                                     .maximum_distance = options.maximum_distance,
                                     .below = options.below},
                                    options.watch);
  Material material;
  material.surface = &surface;
  for (std::size_t c = 0; c < total_channels(work); ++c)
    material.totals.push_back(solve_window(work, c, surface, sky.sky_view_factor));
  Results& results = material.results;
  results.sky_view_factor = std::move(sky.sky_view_factor);
  results.ambient_occlusion = std::move(sky.ambient_occlusion);
  results.moments = std::move(sky.moments);
  if (!request.wanted.horizon_rad.empty()) {
    results.horizons = walk_horizons(surface, {}, plan.walk, request.wanted.horizon_rad,
                                     options.maximum_distance, options.watch);
  }
  return material;
}

/// Values of a texture inside the window, of a material that goes beyond it.
FillRows rows_inside(const BakedTexture& texture, const MapRect& window, const WindowPlace& place) {
  return [&texture, window, place](int first, int rows, float* samples) {
    const int top = window.first_row - place.first_row + first;
    const int left = window.first_column - place.first_column;
    for (int i = 0; i < rows; ++i) {
      for (int j = 0; j < window.columns; ++j) {
        const auto texel = static_cast<std::size_t>(top + i) * static_cast<std::size_t>(place.width) +
                           static_cast<std::size_t>(left + j);
        for (const BakedChannel& channel : texture.channels) *samples++ = channel.value(texel);
      }
    }
  };
}

std::uint64_t missing_inside(const Surface& surface, const MapRect& window) {
  const WindowPlace place = place_in_map(surface);
  std::uint64_t missing = 0;
  for (int i = 0; i < window.rows; ++i) {
    const float* row =
        &surface.map.height(window.first_row - place.first_row + i, window.first_column - place.first_column);
    missing += static_cast<std::uint64_t>(
        std::count_if(row, row + window.columns, [](float height) { return std::isnan(height); }));
  }
  return missing;
}

void check_window(const MapRect& window, const WorkFacts& facts) {
  const bool inside = window.rows > 0 && window.columns > 0 && window.first_row >= 0 &&
                      window.first_column >= 0 && window.rows <= facts.grid.map_height - window.first_row &&
                      window.columns <= facts.grid.map_width - window.first_column;
  if (inside) return;
  throw UsageError("window", "",
                   "must lie inside the map, which has " + std::to_string(facts.grid.map_width) + " × " +
                       std::to_string(facts.grid.map_height) + " texels");
}

BakeOutcome write_window_textures(const Work& work, const Material& material, const MapRect& window,
                                  const BakeTarget& target) {
  const WorkFacts& facts = work.state.facts;
  const Surface& surface = *material.surface;
  const WindowPlace place = place_in_map(surface);
  Heightmap header{.height = {}, .base = facts.base, .spacing = facts.spacing, .boundary = facts.boundary};
  header.height.width = window.columns;
  header.height.height = window.rows;
  const BakedMap map{
      .material = material,
      .header = header,
      .relief = double{facts.highest} - double{facts.lowest},
      .missing = missing_inside(surface, window),
      .sha256 = facts.sha256,
      .place = facts.place ? std::optional(crop_place(*facts.place, window.first_row, window.first_column))
                           : std::nullopt,
      .warnings = facts.warnings};
  const std::vector<BakedTexture> textures = baked_textures(material, work.task.options);
  return write_textures(
      map, textures, [&](std::size_t t) { return rows_inside(textures[t], window, place); },
      work.task.options, target);
}

}  // namespace

BakeOutcome bake_window(const WindowedTask& task, const MapRect& window, const BakeTarget& target) {
  check_windowed(task);
  const WorkPlace place_of_work(task.folder);
  Work work = begin_work(task, 0);
  take_maximum_distance(work);
  check_window(window, work.state.facts);
  for (int part = 0; part < work.state.facts.grid.count(); ++part) find_coarse_blocks(work, part);
  work.state.plan = plan_on(work, middle_crop(window, work.state.facts.grid));
  const int halo = total_channels(work) > 0 ? task.halo : 0;
  const WindowPlace place = widened(window, halo, work.state.facts);
  check_window_memory(work, std::max(place.width, place.height));
  const Surface surface = surface_at(work, place, {work.state.plan->sky.walk, work.state.plan->gather.walk});
  Material material = material_of(work, surface);
  material.results.evidence = evidence_of_plan(work);
  material.results.evidence.sky_check = check_window_sky(work, material, window);
  if (material.results.evidence.sky_check)
    material.results.evidence.sky_rmse = material.results.evidence.sky_check->sky_view_factor;
  return write_window_textures(work, material, window, target);
}

}  // namespace heightlight
