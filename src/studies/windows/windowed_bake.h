#pragma once

#include <functional>
#include <vector>

#include "windows/begin_work.h"
#include "windows/work.h"

namespace heightlight {

/// Throws UsageError for what bakes in one piece alone can do.
void check_windowed(const WindowedTask& task);

/// How work begins where there is none to go on with.
using BeginWork = std::function<Work(WindowedTask task, int side)>;

/// Opens the work folder of a task, or begins it (begin_work.h) where there is none, or one of another
/// request. Of another process's work too: `side` counts where it begins.
Work open_work(WindowedTask task, int side, const BeginWork& begin = begin_work);

/// The same of work that is begun. Throws Error where it is not.
Work join_work(WindowedTask task);

/// What it is called, and which gather it is of, if of one: "sky", "bounces 3".
std::string stage_of(const Work& work);

/// Whether somebody has done a part of the step at hand.
bool is_done(const Work& work, int part);

/// Parts of the step at hand that nobody has done.
std::vector<int> pending_parts(Work& work);

/// Does one of them, whoever else does others.
void do_part(Work& work, int part);

/// When none is pending: on to the next step.
void next_step(Work& work);

/// Writes the files of a bake that is done, and removes its work folder. Throws as bake_material does.
BakeOutcome write_windowed(Work& work, const BakeTarget& target);

/// All of it, in this process.
BakeOutcome bake_in_windows(WindowedTask task, int side, const BakeTarget& target);

}  // namespace heightlight
