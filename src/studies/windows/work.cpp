#include "windows/work.h"

#include <algorithm>
#include <numeric>

#include "bake/material.h"
#include "visibility/distance_table.h"

namespace heightlight {

WindowFolder work_folder(const Work& work, const std::string& name, int level) {
  return {.path = work.task.folder / name, .grid = work.state.facts.grid, .level = level};
}

WindowFolder heights_folder(const Work& work) { return work_folder(work, "heights"); }

WindowFolder coarse_folder(const Work& work) {
  return work_folder(work, "coarse", work.state.facts.first_coarse);
}

WindowFolder sky_folder(const Work& work) { return work_folder(work, "sky"); }

namespace {

bool is_refining(const Work& work) { return !work.state.refined.empty(); }

std::string numbered(const Work& work, const std::string& name, int number) {
  return (is_refining(work) ? "refined_" : "") + name + "_" + std::to_string(number);
}

}  // namespace

WindowFolder lighting_folder(const Work& work) {
  return is_refining(work) ? work_folder(work, "refined_sky") : sky_folder(work);
}

WindowFolder light_folder(const Work& work) {
  return work_folder(work, numbered(work, "light", work.state.gather), work.state.facts.first_coarse);
}

WindowFolder field_folder(const Work& work, int gathers) {
  return work_folder(work, numbered(work, "field", gathers));
}

StoredPlace total_place(const Work& work, std::size_t channel) {
  const std::vector<std::size_t>& refined = work.state.refined;
  const auto at = std::find(refined.begin(), refined.end(), channel);
  const WindowFolder found = field_folder(work, work.state.gather);
  if (at != refined.end()) return {found, kFieldMaps * static_cast<int>(at - refined.begin())};
  return {refined.empty() ? found : work_folder(work, "totals"), kFieldMaps * static_cast<int>(channel)};
}

const HorizonPlan& plan_at_hand(const Work& work) {
  return work.state.refined_plan ? *work.state.refined_plan : *work.state.plan;
}

double error_at_hand(const Work& work) { return work.state.share * work.task.options.error; }

std::vector<std::size_t> channels_at_hand(const Work& work) {
  if (is_refining(work)) return work.state.refined;
  std::vector<std::size_t> all(total_channels(work));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

WindowFolder textures_folder(const Work& work) { return work_folder(work, "textures"); }

MapParts parts_of_map(Work& work, const StoredMap& heights) {
  const WorkFacts& facts = work.state.facts;
  if (!work.coarse) {
    const WindowFolder folder = coarse_folder(work);
    work.coarse = complete_heights(facts.first_coarse,
                                   {.mean = read_whole(folder, 0), .highest = read_whole(folder, 1)});
  }
  return {.heights = heights,
          .base = facts.base,
          .spacing = facts.spacing,
          .boundary = facts.boundary,
          .curvature = facts.curvature,
          .lowest = facts.lowest,
          .highest = facts.highest,
          .coarse = *work.coarse};
}

Surface surface_of_window(Work& work, int window, const std::vector<WalkOptions>& walks) {
  return surface_at(work, work.state.facts.grid.place(window), walks);
}

Surface surface_at(Work& work, const WindowPlace& place, const std::vector<WalkOptions>& walks) {
  const WindowFiles heights(heights_folder(work), 0);
  const MapParts parts = parts_of_map(work, heights);
  WindowView view;
  for (const WalkOptions& walk : walks) {
    const WindowView own = window_view(parts, walk);
    view = {std::max(view.margin, own.margin), std::max(view.levels, own.levels)};
  }
  return window_surface(parts, place, view);
}

void take_maximum_distance(Work& work) {
  const WorkFacts& facts = work.state.facts;
  if (work.task.maximum_distance)
    work.task.options.maximum_distance = work.task.maximum_distance(facts.spacing.x * facts.grid.map_width);
  if (work.task.options.maximum_distance) check_maximum_distance(*work.task.options.maximum_distance);
}

std::size_t total_channels(const Work& work) {
  const BakeOptions& options = work.task.options;
  return is_wanted(options, MaterialMap::multibounce) ? options.albedo.channels() : 0;
}

}  // namespace heightlight
