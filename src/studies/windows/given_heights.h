#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <vector>

#include "windows/work.h"

// Heights that no file holds, and that no process need hold as a whole: they come block by block, a block per
// window, from whoever has them.

namespace heightlight {

/// What a block tells of its heights, in world units.
struct BlockFacts {
  double lowest =
      std::numeric_limits<double>::infinity();  ///< of the samples present; infinite where none is
  double highest = -std::numeric_limits<double>::infinity();
  std::uint64_t missing = 0;
};

/// Keeps the block of a window, row by row and NaN where samples are missing, for the work of a folder, which
/// need not be begun. Its file appears whole. Throws UsageError for heights that are infinite, OutputError.
BlockFacts give_block(const std::filesystem::path& folder, int window, std::span<const double> heights);

/// All blocks together.
struct GivenMap {
  WindowGrid grid = {};
  Spacing spacing = {};
  Boundary boundary = Boundary::open;
  std::vector<BlockFacts> blocks = {};  ///< of all windows
};

/// Begins the work of a task on such a map, or goes on with it; its first step makes the heights above the
/// lowest, as maps in memory have them. `task.map` is what messages call it. Throws UsageError for a side or
/// a spacing that is none, and where no sample is present.
Work open_given_work(WindowedTask task, const GivenMap& map);

}  // namespace heightlight
