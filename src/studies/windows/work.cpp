#include "windows/work.h"

#include <algorithm>

#include "bake/material.h"

namespace heightlight {

WindowFolder work_folder(const Work& work, const std::string& name, int level) {
  return {.path = work.task.folder / name, .grid = work.state.facts.grid, .level = level};
}

WindowFolder heights_folder(const Work& work) { return work_folder(work, "heights"); }

WindowFolder coarse_folder(const Work& work) {
  return work_folder(work, "coarse", work.state.facts.first_coarse);
}

WindowFolder sky_folder(const Work& work) { return work_folder(work, "sky"); }

WindowFolder light_folder(const Work& work) {
  return work_folder(work, "light_" + std::to_string(work.state.gather), work.state.facts.first_coarse);
}

WindowFolder field_folder(const Work& work, int gathers) {
  return work_folder(work, "field_" + std::to_string(gathers));
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
  const WindowFiles heights(heights_folder(work), 0);
  const MapParts parts = parts_of_map(work, heights);
  WindowReach reach;
  for (const WalkOptions& walk : walks) {
    const WindowReach own = window_reach(parts, walk);
    reach = {std::max(reach.margin, own.margin), std::max(reach.levels, own.levels)};
  }
  return window_surface(parts, work.state.facts.grid.place(window), reach);
}

std::size_t total_channels(const Work& work) {
  const BakeOptions& options = work.task.options;
  return is_wanted(options, MaterialMap::multibounce) ? options.albedo.channels() : 0;
}

}  // namespace heightlight
