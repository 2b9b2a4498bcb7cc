#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <utility>

#include "bake/baked_map.h"
#include "base/parallel.h"
#include "files/evidence_json.h"
#include "files/image_file.h"
#include "files/input_file.h"
#include "files/terrain_file.h"
#include "heightlight/error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/python_watch.h"
#include "windows/given_heights.h"
#include "windows/windowed_bake.h"
#include "windows/work_check.h"

namespace heightlight {
namespace {

/// Returns what work() returns. In errors, the side of a window is renamed from out_of_core, as the command
/// calls it, to window, as the package does.
template <class Call>
auto with_names_of_arguments(Call&& work) {
  constexpr std::string_view kSide = "out_of_core";
  try {
    return work();
  } catch (const UsageError& error) {
    if (error.quantity != kSide) throw;
    throw UsageError("window" + std::string(error.what()).substr(kSide.size()));
  }
}

/// This process's part in a bake by windows.
class WorkShare {
 public:
  /// `place` has the entries map, load, side, folder, request, surface, format and depth, as the package sets
  /// them.
  WorkShare(const Settings& settings, const std::vector<std::string>& maps, const py::dict& choice,
            const py::dict& place)
      : settings_(settings) {
    WindowedTask& task = work_.task;
    task.map = place["map"].cast<std::filesystem::path>();
    task.load = read_load_options(place["load"]);
    task.folder = place["folder"].cast<std::filesystem::path>();
    task.options = read_bake_options(maps, choice, settings);
    if (const std::optional<MaximumDistance> maximum_distance =
            std::exchange(task.options.maximum_distance, std::nullopt))
      task.maximum_distance = [maximum_distance](double) { return *maximum_distance; };
    task.options.request = place["request"].cast<std::string>();
    task.options.surface = place["surface"].cast<std::string>();
    set_format(place["format"].cast<std::string>(), place["depth"].cast<std::string>(), task.options);
    check_load_options(task.load);
    check_bake_options(task.options);
    side_ = place["side"].cast<int>();
    with_names_of_arguments([&] {
      check_side(side_);
      check_windowed(task);
    });
  }

  /// Begins the work from the map's file, or continues earlier work.
  void open() {
    run([&] { work_ = with_names_of_arguments([&] { return open_work(work_.task, side_); }); });
  }

  /// Begins the work from blocks of heights that were given, or continues earlier work.
  void open_given(const py::dict& map) {
    GivenMap given;
    const auto [rows, columns] = map["shape"].cast<std::pair<int, int>>();
    const auto [x, y] = map["texel"].cast<std::pair<double, double>>();
    given.grid = {.map_width = columns, .map_height = rows, .side = side_};
    given.spacing = {x, y};
    given.boundary = map["boundary"].cast<std::string>() == "open" ? Boundary::open : Boundary::tile;
    for (const auto& [lowest, highest, missing] :
         map["blocks"].cast<std::vector<std::tuple<double, double, std::uint64_t>>>())
      given.blocks.push_back({lowest, highest, missing});
    run([&] { work_ = with_names_of_arguments([&] { return open_given_work(work_.task, given); }); });
  }

  /// Reads how far other processes are. Data of the map that are held stay if they are still valid.
  void join() {
    run([&] {
      Work joined = join_work(work_.task);
      if (joined.state.facts.first_coarse == work_.state.facts.first_coarse)
        joined.coarse = std::move(work_.coarse);
      work_ = std::move(joined);
    });
  }

  std::string stage() const { return stage_of(work_); }

  std::vector<int> pending() {
    std::vector<int> parts;
    run([&] { parts = pending_parts(work_); });
    return parts;
  }

  /// Does a part, unless another process did it already.
  void run_part(int part) {
    run([&] {
      if (!is_done(work_, part)) do_part(work_, part);
    });
  }

  void advance() {
    run([&] { next_step(work_); });
  }

  /// Writes the files of a finished bake. Returns their names, and the warnings for the user.
  std::pair<std::vector<std::string>, std::vector<std::string>> finish(const std::filesystem::path& folder,
                                                                       const std::string& name,
                                                                       const std::filesystem::path& input) {
    BakeOutcome outcome;
    run([&] {
      const BakeTarget target{.source = work_.task.map, .inputs = {input}, .folder = folder, .name = name};
      outcome = write_windowed(work_, target);
    });
    std::vector<std::string> told;
    for (const Warning& warning : outcome.warnings) told.push_back(warning.message);
    return {baked_files(name, work_.task.options), told};
  }

  /// Bytes of memory that a process needs for the work.
  std::uint64_t bytes() const { return process_bytes(work_); }

  py::dict facts() const {
    const WorkFacts& facts = work_.state.facts;
    py::dict told;
    told["shape"] = py::make_tuple(facts.grid.map_height, facts.grid.map_width);
    told["window"] = facts.grid.side;
    told["texel"] = py::make_tuple(facts.spacing.x, facts.spacing.y);
    if (!facts.place) return told;
    told["system"] = facts.place->system;
    told["in_degrees"] = facts.place->in_degrees;
    told["cell"] = py::make_tuple(facts.place->cell.x, facts.place->cell.y);
    if (facts.place->corner) told["corner"] = *facts.place->corner;
    return told;
  }

  /// Number of channels of a map. They follow those of the maps before it.
  int channels(const std::string& map) const { return component_count(map_named(map), work_.task.options); }

  /// Warnings for the user, once the work is done.
  std::vector<std::string> warnings() const {
    std::vector<std::string> told = find_faults(read_evidence(work_));
    for (const Warning& warning : work_.state.facts.warnings) told.push_back(warning.message);
    return told;
  }

  std::string evidence() const { return evidence_text(read_evidence(work_)); }

 private:
  /// Calls a function without Python's lock (GIL), on the chosen number of threads.
  template <class Call>
  void run(Call&& call) {
    PythonWatch watch(settings_.progress);
    watch.run([&](const Watch& told) {
      const ThreadScope threads(settings_.threads);
      work_.task.options.watch = told;
      call();
      return true;
    });
    work_.task.options.watch = {};
  }

  Settings settings_;
  int side_ = 0;
  Work work_ = {};
};

/// Channels of a window's maps, (count, rows, columns), from the finished work on that request.
py::array_t<float> read_baked_window(const std::filesystem::path& folder, const std::string& request,
                                     int window, int first, int count) {
  std::vector<float> values;
  MapRect rect;
  {
    const py::gil_scoped_release release;
    std::optional<WorkState> state = read_state(folder);
    if (!state || state->step != WorkStep::done || state->facts.request != request)
      throw file_error(folder, "does not hold these maps any more");
    const Work work{.task = {.map = {}, .folder = folder}, .state = std::move(*state)};
    const WindowFolder textures = textures_folder(work);
    rect = textures.rect(window);
    for (int k = first; k < first + count; ++k) {
      const Map map = read_window(textures, window, k);
      values.insert(values.end(), map.values.begin(), map.values.end());
    }
  }
  return take_array(std::move(values), {count, rect.rows, rect.columns});
}

std::tuple<double, double, std::uint64_t> give(const std::filesystem::path& folder, int window,
                                               const Array<double>& heights) {
  const std::span<const double> samples(heights.data(), static_cast<std::size_t>(heights.size()));
  const py::gil_scoped_release release;
  const BlockFacts facts = give_block(folder, window, samples);
  return {facts.lowest, facts.highest, facts.missing};
}

}  // namespace

void add_work(py::module_& module) {
  py::class_<WorkShare>(module, "Work")
      .def(py::init<const Settings&, const std::vector<std::string>&, const py::dict&, const py::dict&>(),
           py::arg("settings"), py::arg("maps"), py::arg("choice"), py::arg("place"))
      .def("open", &WorkShare::open)
      .def("open_given", &WorkShare::open_given, py::arg("map"))
      .def("join", &WorkShare::join)
      .def_property_readonly("stage", &WorkShare::stage)
      .def("pending", &WorkShare::pending)
      .def("run", &WorkShare::run_part, py::arg("part"))
      .def("advance", &WorkShare::advance)
      .def("finish", &WorkShare::finish, py::arg("folder"), py::arg("name"), py::arg("input"))
      .def_property_readonly("bytes", &WorkShare::bytes)
      .def_property_readonly("facts", &WorkShare::facts)
      .def("channels", &WorkShare::channels, py::arg("map"))
      .def_property_readonly("warnings", &WorkShare::warnings)
      .def_property_readonly("evidence", &WorkShare::evidence);
  module.def("give_block", give, py::arg("folder"), py::arg("window"), py::arg("heights"));
  module.def("read_baked_window", read_baked_window, py::arg("folder"), py::arg("request"), py::arg("window"),
             py::arg("first"), py::arg("count"));
  module.def(
      "is_terrain",
      [](const std::filesystem::path& path, const py::dict& load) {
        return is_loaded_as_terrain(read_load_options(load), path);
      },
      py::arg("path"), py::arg("load"));
  module.def(
      "sha256_of_file", [](const std::filesystem::path& path) { return sha256_of_file(path); },
      py::arg("path"));
}

}  // namespace heightlight
