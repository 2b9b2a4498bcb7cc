#include "windows/given_heights.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "files/input_file.h"
#include "files/output_file.h"
#include "heightlight/error.h"
#include "windows/begin_work.h"
#include "windows/steps.h"
#include "windows/whole_file.h"
#include "windows/windowed_bake.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

/// Doubles in the machine's order. It is beside the work folder, which is made anew when the work begins.
fs::path block_file(const fs::path& folder, int window) {
  return given_folder(folder) / (std::to_string(window) + ".raw");
}

std::vector<double> read_block(const fs::path& path, std::size_t count) {
  std::vector<double> heights(count);
  const File file = open_input(path);
  if (std::fread(heights.data(), sizeof(double), count, file.get()) != count)
    throw file_error(path, "is cut short; begin anew without its folder");
  return heights;
}

/// What the blocks tell together.
BlockFacts facts_of_all(const std::vector<BlockFacts>& blocks) {
  BlockFacts all;
  for (const BlockFacts& block : blocks) {
    all.lowest = std::min(all.lowest, block.lowest);
    all.highest = std::max(all.highest, block.highest);
    all.missing += block.missing;
  }
  if (std::isinf(all.lowest)) throw UsageError("height", "", "has no samples, or all are missing");
  return all;
}

}  // namespace

fs::path given_folder(const fs::path& folder) { return folder.string() + ".given"; }

BlockFacts give_block(const fs::path& folder, int window, std::span<const double> heights) {
  BlockFacts facts;
  for (const double height : heights) {
    if (std::isinf(height)) throw UsageError("height", "", "has infinite samples; NaN means missing");
    if (std::isnan(height)) {
      ++facts.missing;
      continue;
    }
    facts.lowest = std::min(facts.lowest, height);
    facts.highest = std::max(facts.highest, height);
  }
  std::error_code failure;
  fs::create_directories(given_folder(folder), failure);
  if (failure) throw output_error(given_folder(folder), failure.message());
  const fs::path file = block_file(folder, window);
  write_file(unfinished(file),
             [&](std::FILE* stream) { std::fwrite(heights.data(), sizeof(double), heights.size(), stream); });
  appear(file);
  return facts;
}

Work open_given_work(WindowedTask task, const GivenMap& map) {
  check_load_options({.texel = map.spacing});
  const BlockFacts all = facts_of_all(map.blocks);
  const fs::path blocks = given_folder(task.folder);
  Work work = open_work(std::move(task), map.grid.side, [&](WindowedTask own, int side) {
    return begin_work_of(std::move(own), side,
                         {.request = {},
                          .grid = map.grid,
                          .base = all.lowest,
                          .spacing = map.spacing,
                          .boundary = map.boundary,
                          .lowest = 0,
                          .highest = static_cast<float>(all.highest - all.lowest),
                          .missing = all.missing});
  });
  std::error_code ignored;
  if (work.state.step != WorkStep::heights)
    fs::remove_all(blocks, ignored);  // they were made heights earlier
  return work;
}

void find_window_heights(const Work& work, int window) {
  const WorkFacts& facts = work.state.facts;
  const WindowPlace place = facts.grid.place(window);
  Map map(place.width, place.height);
  const std::vector<double> heights = read_block(block_file(work.task.folder, window), map.size());
  std::transform(heights.begin(), heights.end(), map.values.begin(),
                 [&](double height) { return static_cast<float>(height - facts.base); });
  write_window(heights_folder(work), window, {&map});
}

}  // namespace heightlight
