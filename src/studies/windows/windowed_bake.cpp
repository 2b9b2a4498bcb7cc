#include "windows/windowed_bake.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <system_error>

#include "bake/material.h"
#include "base/progress.h"
#include "files/input_file.h"
#include "files/interrupt.h"
#include "files/output_file.h"
#include "heightlight/error.h"
#include "solve/solver.h"
#include "windows/begin_work.h"
#include "windows/steps.h"
#include "windows/work_check.h"
#include "windows/work_place.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

const char* name_of(WorkStep step) {
  switch (step) {
    case WorkStep::heights:
      return "heights";
    case WorkStep::coarse:
      return "coarse levels";
    case WorkStep::plan:
      return "plan";
    case WorkStep::sky:
      return "sky";
    case WorkStep::light:
      return "light";
    case WorkStep::gather:
      return "bounces";
    case WorkStep::check:
      return "check";
    case WorkStep::textures:
      return "textures";
    case WorkStep::done:
      break;
  }
  return "done";
}

int count_parts(Work& work) {
  switch (work.state.step) {
    case WorkStep::plan:
      return static_cast<int>(plan_crops(work).size());
    case WorkStep::check:
      return 1;
    case WorkStep::done:
      return 0;
    default:
      return work.state.facts.grid.count();
  }
}

/// Where the file of a part is when it is done.
fs::path part_file(const Work& work, int part) {
  const bool refines = !work.state.refined.empty();
  switch (work.state.step) {
    case WorkStep::heights:
      return heights_folder(work).file(part);
    case WorkStep::coarse:
      return coarse_folder(work).file(part);
    case WorkStep::plan:
      return work_folder(work, refines ? "refined_plan" : "plan").path / fmt::format("{:04}.json", part);
    case WorkStep::sky:
      return lighting_folder(work).file(part);
    case WorkStep::light:
      return light_folder(work).file(part);
    case WorkStep::gather:
      return field_folder(work, work.state.gather + 1).file(part);
    case WorkStep::check:
      return work.task.folder / "check" / (refines ? "0001.json" : "0000.json");
    case WorkStep::textures:
      return textures_folder(work).file(part);
    case WorkStep::done:
      break;
  }
  return {};
}

void make_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw output_error(folder, failure.message());
}

/// Where it was moved already, by a process that was killed afterwards, nothing is left to do.
void move_folder(const fs::path& from, const fs::path& to) {
  std::error_code failure;
  if (!fs::exists(from, failure)) return;
  fs::rename(from, to, failure);
  if (failure) throw output_error(to, failure.message());
}

/// What is not needed any more.
void drop_folder(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

/// On to a gather: what it steps and keeps is known then.
void begin_light(Work& work) {
  for (GatherCourse& course : work.state.courses) {
    if (azimuths_of_gather(course, work.state.gather) > 0) begin_gather(work.state.gather, course);
  }
  work.state.step = WorkStep::light;
  make_folder(light_folder(work).path);
  make_folder(field_folder(work, work.state.gather + 1).path);
}

void end_gathers(Work& work) {
  const int k = work.state.gather;
  for (std::size_t c = 0; c < work.state.courses.size() && k < kTellingGathers; ++c) {
    GatherCourse& course = work.state.courses[c];
    if (azimuths_of_gather(course, k) > 0)
      end_gather(k, change_of_gather(work, c), true, error_at_hand(work), course);
  }
  ++work.state.gather;
  const bool all_ended =
      std::all_of(work.state.courses.begin(), work.state.courses.end(),
                  [&](const GatherCourse& course) { return azimuths_of_gather(course, k + 1) == 0; });
  if (all_ended) {
    work.state.step = WorkStep::check;
  } else {
    begin_light(work);
  }
}

/// Totals that miss the error are found once more, as find_totals does, but all of them for the same share of
/// it.
void end_check(Work& work) {
  work.state.step = WorkStep::textures;
  if (!work.state.refined.empty() || total_channels(work) == 0) return;
  const std::vector<HorizonCheck> checks = read_total_checks(work);
  std::vector<std::size_t> missed;
  double share = 1;
  for (std::size_t c = 0; c < checks.size(); ++c) {
    const double wanted = work.task.options.error;
    const HorizonCheck& check = checks[c];
    if (check.receivers == 0 || !is_missed(check.total_rmse, wanted, check.total_standard_error)) continue;
    missed.push_back(c);
    share = std::min(share, check.total_rmse > kMissedByMuch * wanted ? kMuchFiner : kFiner);
  }
  if (missed.empty()) return;
  move_folder(field_folder(work, work.state.gather).path, work_folder(work, "totals").path);
  work.state.refined = missed;
  work.state.share = share;
  work.state.gather = 0;
  work.state.courses.clear();
  work.state.step = WorkStep::plan;
  make_folder(work_folder(work, "refined_plan").path);
  make_folder(lighting_folder(work).path);
}

void advance(Work& work) {
  switch (work.state.step) {
    case WorkStep::heights:
      work.state.step = WorkStep::coarse;
      return;
    case WorkStep::coarse:
      work.state.step = WorkStep::plan;
      return;
    case WorkStep::plan:
      (work.state.refined.empty() ? work.state.plan : work.state.refined_plan) = choose_plan(work);
      work.state.step = WorkStep::sky;
      return;
    case WorkStep::sky:
      if (total_channels(work) == 0) {
        work.state.step = WorkStep::check;
        return;
      }
      begin_courses(work);
      begin_light(work);
      return;
    case WorkStep::light:
      work.state.step = WorkStep::gather;
      return;
    case WorkStep::gather:
      end_gathers(work);
      return;
    case WorkStep::check:
      end_check(work);
      return;
    default:
      work.state.step = WorkStep::done;
  }
}

/// Files that later steps do not read.
void drop_former(const Work& work) {
  if (work.state.step > WorkStep::heights) drop_folder(given_folder(work.task.folder));
  if (work.state.step == WorkStep::done) {
    for (const WindowFolder& folder : {heights_folder(work), coarse_folder(work), sky_folder(work),
                                       light_folder(work), field_folder(work, work.state.gather)})
      drop_folder(folder.path);
  }
  Work former = work;
  for (int k = 0; k < work.state.gather; ++k) {
    former.state.gather = k;
    drop_folder(light_folder(former).path);
    drop_folder(field_folder(former, k).path);
  }
}

}  // namespace

void check_windowed(const WindowedTask& task) {
  const BakeOptions& options = task.options;
  const auto refuse = [](const char* option, const std::string& value, const char* what) {
    throw UsageError(option, value, std::string(what) + " cannot be baked window by window");
  };
  if (options.light_channels > 0) refuse("light", "", "light of one's own");
  if (options.draw_sheet) refuse("sheet", "", "a sheet");
  if (!options.albedo.varying.empty()) refuse("albedo", "", "an albedo that varies over the map");
  if (!options.own.empty()) refuse("pack", "", "channels of files of one's own");
  for (const MaterialMap map : {MaterialMap::ao_n, MaterialMap::specular_occlusion, MaterialMap::curvature,
                                MaterialMap::convexity, MaterialMap::concavity, MaterialMap::cavity}) {
    if (is_wanted(options, map)) refuse("maps", to_string(map), to_string(map));
  }
  for (const MaterialMapName& entry : material_maps()) {
    if (definition_of(entry.map) && is_wanted(options, entry.map)) refuse("maps", entry.name, entry.name);
  }
  const bool bounces = is_wanted(options, MaterialMap::multibounce);
  if (bounces && task.maximum_distance)
    refuse("max_distance", "", "multibounce beside maps with a maximum distance");
  if (bounces && options.below == BelowHorizontal::ground)
    refuse("below_horizontal", "ground", "multibounce under a sky that ends at the horizontal");
}

namespace {

/// What hangs on the map, once it is known.
Work with_maximum_distance(Work work) {
  take_maximum_distance(work);
  return work;
}

}  // namespace

Work join_work(WindowedTask task) {
  std::optional<WorkState> state = read_state(task.folder);
  if (!state || state->facts.request != task.options.request)
    throw file_error(task.folder, "holds no work of this bake");
  return with_maximum_distance({.task = std::move(task), .state = std::move(*state)});
}

Work open_work(WindowedTask task, int side, const BeginWork& begin) {
  check_windowed(task);
  std::optional<WorkState> state = read_state(task.folder);
  const bool goes_on =
      state && state->facts.request == task.options.request && (side == 0 || side == state->facts.grid.side);
  if (!goes_on) return with_maximum_distance(begin(std::move(task), side));
  return with_maximum_distance({.task = std::move(task), .state = std::move(*state)});
}

std::string stage_of(const Work& work) {
  const bool is_of_gather = work.state.step == WorkStep::light || work.state.step == WorkStep::gather;
  std::string stage(name_of(work.state.step));
  // Piece by piece: g++ 12 warns falsely of " " + a string that ends here.
  if (is_of_gather) stage.append(" ").append(std::to_string(work.state.gather));
  return stage;
}

bool is_done(const Work& work, int part) {
  std::error_code ignored;
  return fs::exists(part_file(work, part), ignored);
}

std::vector<int> pending_parts(Work& work) {
  std::vector<int> parts(static_cast<std::size_t>(count_parts(work)));
  std::iota(parts.begin(), parts.end(), 0);
  std::erase_if(parts, [&](int part) { return is_done(work, part); });
  return parts;
}

void do_part(Work& work, int part) {
  switch (work.state.step) {
    case WorkStep::heights:
      return find_window_heights(work, part);
    case WorkStep::coarse:
      return find_coarse_blocks(work, part);
    case WorkStep::plan:
      return plan_on_crop(work, part);
    case WorkStep::sky:
      return find_window_sky(work, part);
    case WorkStep::light:
      return find_window_light(work, part);
    case WorkStep::gather:
      return gather_window(work, part);
    case WorkStep::check:
      return check_receivers(work);
    case WorkStep::textures:
      return find_window_textures(work, part);
    case WorkStep::done:
      return;
  }
}

void next_step(Work& work) {
  advance(work);
  write_state(work.task.folder, work.state);
  drop_former(work);
}

BakeOutcome bake_in_windows(WindowedTask task, int side, const BakeTarget& target) {
  check_windowed(task);
  WorkPlace place(task.folder);
  Work work = open_work(std::move(task), side);
  place.keep();
  Watch watch = work.task.options.watch;
  work.task.options.watch.tell = {};  // steps are told of, window by window
  while (work.state.step != WorkStep::done) {
    const std::vector<int> parts = pending_parts(work);
    Progress progress(name_of(work.state.step), static_cast<std::int64_t>(parts.size()), watch);
    for (const int part : parts) {
      progress.throw_if_stopped();
      do_part(work, part);
      progress.add(1);
    }
    next_step(work);
  }
  return write_windowed(work, target);
}

}  // namespace heightlight
