#include "cli/relief_match.h"

#include <fmt/core.h>

#include <cmath>
#include <variant>

#include "base/digits.h"
#include "cli/terminal_watch.h"
#include "cli/warnings.h"
#include "files/printable.h"
#include "files/shipped_map.h"
#include "relief/match_relief.h"

namespace heightlight {
namespace {

void check_shape(const std::filesystem::path& path, int width, int height, const Image<float>& heights) {
  const double own = static_cast<double>(heights.width) / heights.height;
  if (std::fabs(static_cast<double>(width) / height / own - 1) < 0.01) return;
  throw file_error(path, fmt::format("is {} × {}, which has other proportions than the heightmap of {} × {}",
                                     width, height, heights.width, heights.height));
}

ReliefMatch match_to(const std::filesystem::path& path, const ShippedMap& shipped, const Heightmap& map,
                     const Watch& watch) {
  std::visit([&](const auto& image) { check_shape(path, image.width, image.height, map.height); }, shipped);
  if (const auto* normals = std::get_if<Image<Vector3>>(&shipped)) return match_normals(map, *normals);
  return match_occlusion(map, std::get<Map>(shipped), watch);
}

std::string describe(const std::filesystem::path& path, const ShippedMap& shipped, const ReliefMatch& match) {
  const bool is_normals = std::holds_alternative<Image<Vector3>>(shipped);
  const std::string left = is_normals ? fmt::format("normals within {:.2g} degrees", match.residual)
                                      : fmt::format("occlusion within {:.2g}", match.residual);
  return fmt::format("matched to {}: {} (root mean square), correlation {:.2f}{}",
                     printable(path.filename().string()), left, match.correlation,
                     match.y_down ? "; its y points down, as with --normal-y directx" : "");
}

}  // namespace

BakeCommand with_matched_relief(const BakeCommand& command, const BakeInput& input) {
  const ShippedMap shipped = read_shipped_map(command.match, command.run.memory);
  const LoadedHeightmap loaded = load_heightmap(input.path, command.load, command.run.memory, match_bytes);
  const Heightmap& map = loaded.map;
  const ReliefMatch match = match_to(command.match, shipped, map, terminal_watch(command.run.quiet));
  BakeCommand matched = command;
  matched.load.relief = match.relief;
  matched.relief_from = describe(command.match, shipped, match);
  const double width = map.spacing.x * map.height.width;
  const std::string relief = in_digits(match.relief, 3);
  if (!command.run.quiet)
    fmt::print("{}: relief {} ({:.2g} % of the width), {}\n", printable(input.path), relief,
               100 * match.relief / width, matched.relief_from);
  if (!match.doubt.empty())
    tell_warnings(input.path, {{"the relief of --match is doubtful: " + match.doubt}});
  return matched;
}

}  // namespace heightlight
