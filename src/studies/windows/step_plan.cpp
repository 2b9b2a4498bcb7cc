#include "windows/step_plan.h"

#include <fmt/core.h>

#include <algorithm>

#include "files/json_file.h"
#include "solve/solver.h"
#include "transport/horizon_plan.h"
#include "window/read_around.h"
#include "windows/sky_maps.h"
#include "windows/steps.h"
#include "windows/work_json.h"

namespace heightlight {
namespace {

std::filesystem::path plan_file(const Work& work, int crop) {
  return work_folder(work, work.state.refined.empty() ? "plan" : "refined_plan").path /
         fmt::format("{:04}.json", crop);
}

/// Mean of what the highest of blocks have above their means.
double roughness(const CoarseHeights& coarse, const MapRect& crop) {
  const HeightPyramid::Level& level = coarse.levels[0];
  const int side = 1 << coarse.first;
  double sum = 0;
  int blocks = 0;
  for (int i = crop.first_row / side; i * side < crop.first_row + crop.rows; ++i) {
    for (int j = crop.first_column / side; j * side < crop.first_column + crop.columns; ++j, ++blocks) {
      if (level.mean(i, j) != kNoHeight) sum += double{level.highest(i, j)} - double{level.mean(i, j)};
    }
  }
  return sum / blocks;
}

/// A crop as a map of its own. Nothing is around it, unless it is the whole.
Surface crop_surface(const Work& work, const MapRect& crop) {
  const WorkFacts& facts = work.state.facts;
  const bool whole = crop.rows == facts.grid.map_height && crop.columns == facts.grid.map_width;
  const WindowFiles heights(heights_folder(work), 0);
  return build_surface({.height = read_around(heights, facts.boundary, crop),
                        .base = facts.base,
                        .spacing = facts.spacing,
                        .boundary = whole ? facts.boundary : Boundary::open,
                        .curvature = facts.curvature,
                        .curved_about_row = 0.5 * (facts.grid.map_height - 1) - crop.first_row,
                        .curved_about_column = 0.5 * (facts.grid.map_width - 1) - crop.first_column});
}

HorizonPlan find_plan(const Work& work, const Surface& surface) {
  const BakeOptions& options = work.task.options;
  const SkyWanted moments = sky_wanted(options);
  Request request;
  request.accuracy = {.error = options.error, .azimuths = options.azimuths, .seed = options.seed};
  HorizonGoal goal = plan_goal(request, moments.first);
  goal.error = error_at_hand(work);
  HorizonPlan plan;
  if (total_channels(work) > 0) {
    plan = plan_horizon_transport(surface, goal, {}, options.watch).plan;
  } else {
    const HeightPyramid pyramid = build_height_pyramid(surface);
    SkyCalibration calibration(surface, pyramid,
                               {.seed = options.seed, .watch = options.watch, .below = options.below});
    plan.sky = plan_sky(calibration, goal);
  }
  if (options.maximum_distance) {
    plan.sky.full_from = 0;
    plan.sky.full_share = 1;
  }
  return plan;
}

/// Of what gathers cost, as far as plans differ.
double walk_cost(const WalkOptions& walk) {
  return double{1} * walk.azimuths * (20 + walk.samples_per_octave);
}

}  // namespace

MapRect middle_crop(const MapRect& window, const WindowGrid& grid) {
  const auto along = [](int first, int count, int samples) {
    const int side = std::min(kCropSide, samples);
    return std::pair(std::clamp(first + count / 2 - side / 2, 0, samples - side), side);
  };
  const auto [top, rows] = along(window.first_row, window.rows, grid.map_height);
  const auto [left, columns] = along(window.first_column, window.columns, grid.map_width);
  return {top, left, rows, columns};
}

HorizonPlan plan_on(const Work& work, const MapRect& crop) {
  return find_plan(work, crop_surface(work, crop));
}

std::vector<MapRect> plan_crops(Work& work) {
  const WindowGrid& grid = work.state.facts.grid;
  const int rows = std::min(kCropSide, grid.map_height);
  const int columns = std::min(kCropSide, grid.map_width);
  std::vector<MapRect> crops;
  for (int row = 0; row + rows <= grid.map_height; row += rows) {
    for (int column = 0; column + columns <= grid.map_width; column += columns)
      crops.push_back({row, column, rows, columns});
  }
  const WindowFiles heights(heights_folder(work), 0);
  const CoarseHeights& coarse = parts_of_map(work, heights).coarse;
  std::stable_sort(crops.begin(), crops.end(), [&](const MapRect& a, const MapRect& b) {
    return roughness(coarse, a) > roughness(coarse, b);
  });
  const std::size_t count = crops.size();
  if (count <= 3) return crops;
  return {crops[0], crops[count / 4], crops[count / 2]};
}

void plan_on_crop(Work& work, int crop) {
  const HorizonPlan plan = plan_on(work, plan_crops(work)[static_cast<std::size_t>(crop)]);
  replace_json(plan_file(work, crop), to_json(plan));
}

HorizonPlan choose_plan(Work& work) {
  HorizonPlan chosen;
  const auto count = static_cast<int>(plan_crops(work).size());
  for (int crop = 0; crop < count; ++crop) {
    const HorizonPlan plan = plan_of(read_json(plan_file(work, crop)));
    if (crop == 0 || sky_cost(plan.sky) > sky_cost(chosen.sky)) chosen.sky = plan.sky;
    if (crop == 0 || walk_cost(plan.gather.walk) > walk_cost(chosen.gather.walk)) chosen.gather = plan.gather;
  }
  return chosen;
}

}  // namespace heightlight
