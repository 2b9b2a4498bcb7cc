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
  BakeOptions options = {};                       ///< those that depend on the map are set once it is known
  std::function<Reach(double width)> reach = {};  ///< of the map's extent along x, where a reach is wanted
  std::filesystem::path folder = {};
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
  std::vector<GatherCourse> courses = {};  ///< per channel of the total
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
  std::optional<CoarseHeights> coarse = {};  ///< once coarse_heights_of_map was asked for them
};

/// Files of the windows, by what they hold.
WindowFolder work_folder(const Work& work, const std::string& name, int level = 0);
WindowFolder heights_folder(const Work& work);
/// A block is a float; mean and highest heights, and the highest of what occludes along cells.
WindowFolder coarse_folder(const Work& work);
/// A, then what else is wanted of the sky (sky_maps.h).
WindowFolder sky_folder(const Work& work);
/// Of the gather at hand: the coarse radiosity per channel.
WindowFolder light_folder(const Work& work);
/// After so many gathers: E_k, E_{k−1}, N and W per channel, kFieldMaps of them; there is none of 0.
constexpr int kFieldMaps = 4;
WindowFolder field_folder(const Work& work, int gathers);
WindowFolder textures_folder(const Work& work);

/// The map by its parts, with coarse levels that are read when first asked for. `heights` must outlive it.
MapParts parts_of_map(Work& work, const StoredMap& heights);

/// A window's surface, for such walks.
Surface surface_of_window(Work& work, int window, const std::vector<WalkOptions>& walks);

/// Channels of the total that is wanted; 0 where none is.
std::size_t total_channels(const Work& work);

}  // namespace heightlight
