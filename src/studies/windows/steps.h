#pragma once

#include "windows/work.h"

// The parts of each step. Each writes its file, which appears whole.

namespace heightlight {

/// Of the block that was given, above the base.
void find_window_heights(const Work& work, int window);

void find_coarse_blocks(const Work& work, int window);

/// Crops of the map that it is planned on: the roughest, and some that are less rough; the map itself where
/// it is no larger.
std::vector<MapRect> plan_crops(Work& work);
void plan_on_crop(Work& work, int crop);
/// The plan of the crop that wants most. Reads what plan_on_crop wrote.
HorizonPlan choose_plan(Work& work);

void find_window_sky(Work& work, int window);

/// Courses and classes, once the sky is known.
void begin_courses(Work& work);
void find_window_light(Work& work, int window);
void gather_window(Work& work, int window);
/// What the gather at hand has changed of a channel, all windows together.
ChangeSum change_of_gather(const Work& work, std::size_t channel);

/// Bytes that the check keeps of heights, A and totals, all threads together.
constexpr std::uint64_t kPagedBytes = 96ULL << 20;
void check_receivers(Work& work);

void find_window_textures(Work& work, int window);

}  // namespace heightlight
