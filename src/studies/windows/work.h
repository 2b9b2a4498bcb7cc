#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "transport/gather_course.h"
#include "window/window_surface.h"
#include "windows/window_files.h"

// A bake of a map that memory does not hold goes on window by window, in steps. All that a step finds is in
// files of a work folder, so that a bake that was stopped goes on where it was, and so that processes can
// share the windows of a step. What is found depends on neither, nor on the windows' size: it is the same to
// the last bit.

namespace heightlight {

/// What is to be baked, and where the work folder is.
struct WindowedTask {
  std::filesystem::path map;
  LoadOptions load = {};
  BakeOptions options = {};  ///< those that depend on the map are set once it is known
  std::function<MaximumDistance(double width)> maximum_distance =
      {};  ///< of the map's extent along x, where a maximum distance is wanted
  std::filesystem::path folder = {};
  int halo = 256;  ///< texels around a single window (bake_window.h) in which its own light is found, too
};

/// What all windows have in common.
struct WorkFacts {
  std::string request;  ///< BakeOptions::request: all that results depend on
  WindowGrid grid = {};
  int first_coarse = 0;  ///< level from which on levels are held as a whole
  double base = 0;
  Spacing spacing = {};
  Boundary boundary = Boundary::open;
  double curvature = 0;
  float lowest = 0;
  float highest = 0;
  std::uint64_t missing = 0;
  std::string sha256 = {};  ///< of the map's file
  std::optional<Georeference> place = {};
  std::vector<Warning> warnings = {};
};

/// Steps, in the order in which they are taken; light and gather take turns.
enum class WorkStep {
  heights,   ///< of blocks that were given (given_heights.h); a map's file is read before the first step
  coarse,    ///< each window's blocks of the first coarse level
  plan,      ///< how to walk, from crops of the map
  sky,       ///< each window's shares of the sky
  light,     ///< before each gather, the coarse blocks of what it looks at
  gather,    ///< one gather of each window's receivers, as progressive_gather.h has it
  check,     ///< of some receivers, by exact walks over the whole map
  textures,  ///< each window's channels of all files
  done
};

/// How far the work is.
struct WorkState {
  WorkFacts facts = {};
  WorkStep step = WorkStep::coarse;
  int gather = 0;  ///< k of the gather at hand
  std::optional<HorizonPlan> plan = {};
  /// Channels of the total that missed the error, and are found once more, for a share of it: with a plan and
  /// an A of their own. Empty before.
  std::vector<std::size_t> refined = {};
  double share = 1;
  std::optional<HorizonPlan> refined_plan = {};
  std::vector<GatherCourse> courses = {};  ///< per channel that is gathered
  std::vector<double> class_sample = {};   ///< A of the receivers that classes are made by
};

/// Reads what write_state wrote; nothing where there is none, or another version's. Throws Error for a
/// damaged one.
std::optional<WorkState> read_state(const std::filesystem::path& folder);
void write_state(const std::filesystem::path& folder, const WorkState& state);

/// The work of one process: its task, how far all are, and what it holds of the map.
struct Work {
  WindowedTask task;
  WorkState state;
  std::optional<CoarseHeights> coarse = {};  ///< once parts_of_map read them
};

/// Files of the windows, by what they hold.
WindowFolder work_folder(const Work& work, const std::string& name, int level = 0);
WindowFolder heights_folder(const Work& work);
/// Beside the work folder: blocks of heights that were given (given_heights.h).
std::filesystem::path given_folder(const std::filesystem::path& folder);
/// A block is a float; mean and highest heights, and the highest of what occludes along cells.
WindowFolder coarse_folder(const Work& work);
/// A, then what else is wanted of the sky (sky_maps.h).
WindowFolder sky_folder(const Work& work);
/// Of the gather at hand: the coarse radiosity per channel.
WindowFolder light_folder(const Work& work);
/// The sky that totals are found under, of which A comes first: that of the maps, until they are refined.
WindowFolder lighting_folder(const Work& work);
/// After so many gathers: E_k, E_{k−1}, N and W per channel, kFieldMaps of them; there is none of 0.
constexpr int kFieldMaps = 4;
WindowFolder field_folder(const Work& work, int gathers);
WindowFolder textures_folder(const Work& work);

/// A map in a folder.
struct StoredPlace {
  WindowFolder folder;
  int k = 0;
};
/// The total of a channel, once it is found.
StoredPlace total_place(const Work& work, std::size_t channel);

/// What is walked by at hand: the refined plan, when totals are refined.
const HorizonPlan& plan_at_hand(const Work& work);
/// RMSE that is wanted at hand.
double error_at_hand(const Work& work);
/// Channels that are gathered at hand: all, or those that are refined.
std::vector<std::size_t> channels_at_hand(const Work& work);

/// The map by its parts, with coarse levels that are read when first asked for. `heights` must outlive it.
MapParts parts_of_map(Work& work, const StoredMap& heights);

/// A window's surface, for such walks.
Surface surface_of_window(Work& work, int window, const std::vector<WalkOptions>& walks);

/// The same of any place in the map.
Surface surface_at(Work& work, const WindowPlace& place, const std::vector<WalkOptions>& walks);

/// Sets the maximum distance that is wanted, once the map is known. Throws UsageError for one out of its
/// range.
void take_maximum_distance(Work& work);

/// Channels of the total that is wanted; 0 where none is.
std::size_t total_channels(const Work& work);

}  // namespace heightlight
