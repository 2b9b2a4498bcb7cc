#include "cli/bake_windows.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "cli/albedo.h"
#include "cli/bake_report.h"
#include "cli/name_errors.h"
#include "cli/reach_options.h"
#include "cli/terminal_watch.h"
#include "files/image_file.h"
#include "files/input_file.h"
#include "heightlight/error.h"
#include "report/preview.h"
#include "windows/bake_window.h"
#include "windows/windowed_bake.h"

namespace heightlight {
namespace {

/// Of a map that is baked window by window, all that can be told without reading it.
WindowedTask windowed_task(const BakeCommand& command, const BakeInput& input) {
  WindowedTask task{.map = input.path, .load = command.load, .options = options_for(command, input.path)};
  task.options.albedo = announced_albedo(command.albedo);
  const std::uint64_t report = bake_report_bytes(kLargestPreview, kLargestPreview, task.options);
  task.options.memory -= std::min(task.options.memory, report);
  task.folder = command.folder / ("." + input.name + ".windows");
  if (!command.max_distance.empty()) {
    task.maximum_distance = [&command](double width) {
      return MaximumDistance{.distance = parse_distance("max_distance", command.max_distance, width),
                             .falloff = falloff_named(command.falloff)};
    };
  }
  return task;
}

/// The task, once it is known that windows can do it, with what tells it from other requests.
WindowedTask requested_task(const BakeCommand& command, const BakeInput& input, bool quiet) {
  WindowedTask task = windowed_task(command, input);
  check_windowed(task);
  const std::string sha256 = sha256_of_file(input.path);
  task.options.surface = surface_of(command, task.options, sha256);
  task.options.request = request_of(command, task.options, sha256, "");
  task.options.watch = terminal_watch(quiet);
  return task;
}

/// COLUMN,ROW,WIDTH,HEIGHT.
MapRect parse_window(const std::string& text) {
  std::array<int, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [stop, fault] = std::from_chars(at, end, numbers[i]);
    const bool goes_on = i + 1 < numbers.size();
    if (fault != std::errc() || (goes_on ? stop == end || *stop != ',' : stop != end))
      throw UsageError("window", text, "must be COLUMN,ROW,WIDTH,HEIGHT, such as 2048,1024,512,512");
    at = stop + 1;
  }
  return {.first_row = numbers[1], .first_column = numbers[0], .rows = numbers[3], .columns = numbers[2]};
}

}  // namespace

bool can_be_windowed(const BakeCommand& command, const BakeInput& input) {
  try {
    check_windowed(windowed_task(command, input));
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

BakeOutcome bake_by_windows(const BakeCommand& command, const BakeInput& input, const InputGuard& guard,
                            bool quiet) {
  WindowedTask task = requested_task(command, input, quiet);
  const BakeTarget target{
      .source = input.path, .inputs = guard, .folder = command.folder, .name = input.name};
  return name_errors(input.path,
                     [&] { return bake_in_windows(std::move(task), command.windows.value_or(0), target); });
}

BakeOutcome bake_one_window(const BakeCommand& command, const BakeInput& input, const InputGuard& guard,
                            bool quiet) {
  const MapRect window = parse_window(command.window);
  const WindowedTask task = requested_task(command, input, quiet);
  const BakeTarget target{
      .source = input.path, .inputs = guard, .folder = command.folder, .name = input.name};
  return name_errors(input.path, [&] { return bake_window(task, window, target); });
}

}  // namespace heightlight
