#include "heightlight/files.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "base/machine_share.h"
#include "files/degrees.h"
#include "python/arrays.h"
#include "python/bindings.h"

namespace heightlight {
namespace {

py::dict describe_facts(const SourceFacts& facts) {
  py::dict told;
  told["format"] = facts.format;
  told["sample_type"] = facts.sample_type;
  told["bits"] = facts.bits;
  told["stretched"] = facts.is_stretched;
  told["channels"] = facts.channels;
  told["channel"] = facts.channel;
  told["levels"] = facts.levels;
  told["lowest"] = facts.lowest;
  told["highest"] = facts.highest;
  told["no_data"] = facts.declared_no_data;
  told["sha256"] = facts.sha256;
  return told;
}

}  // namespace

LoadOptions read_load_options(const py::dict& options) {
  LoadOptions load;
  const auto take = [&](const char* name, auto& value) {
    using Value = typename std::decay_t<decltype(value)>::value_type;
    if (options.contains(name) && !options[name].is_none()) value = options[name].cast<Value>();
  };
  take("relief", load.relief);
  take("relief_share", load.relief_share);
  take("width", load.width);
  take("no_data", load.no_data);
  take("scale", load.scale);
  take("offset", load.offset);
  if (options.contains("size")) {
    const auto [rows, columns] = options["size"].cast<std::pair<int, int>>();
    load.size = {columns, rows};
  }
  if (options.contains("big_endian")) load.big_endian = options["big_endian"].cast<bool>();
  take("part", load.part);
  take("channel", load.channel);
  if (options.contains("texel") && py::isinstance<py::str>(options["texel"])) {
    load.degrees_in_metres = true;
  } else if (options.contains("texel")) {
    const auto [x, y] = options["texel"].cast<std::pair<double, double>>();
    load.texel = Spacing{x, y};
  }
  if (options.contains("boundary"))
    load.boundary = options["boundary"].cast<std::string>() == "open" ? Boundary::open : Boundary::tile;
  if (options.contains("shrink")) load.shrink = options["shrink"].cast<int>();
  if (options.contains("invert")) load.invert = options["invert"].cast<bool>();
  return load;
}

namespace {

py::dict read_heights(const std::filesystem::path& path, const py::dict& options) {
  const LoadOptions load = read_load_options(options);
  LoadedHeightmap loaded;
  {
    const py::gil_scoped_release release;
    check_load_options(load);
    loaded = load_heightmap(path, load, default_memory(default_threads()));
  }
  py::list warnings;
  for (const Warning& warning : loaded.warnings) warnings.append(warning.message);
  py::dict found;
  found["texel"] = py::make_tuple(loaded.map.spacing.x, loaded.map.spacing.y);
  found["boundary"] = to_string(loaded.map.boundary);
  found["base"] = loaded.map.base;
  found["facts"] = describe_facts(loaded.facts);
  found["warnings"] = warnings;
  found["heights"] = take_map(std::move(loaded.map.height));
  return found;
}

}  // namespace

void add_files(py::module_& module) {
  module.def("read", read_heights, py::arg("path"), py::arg("options"));
  module.def(
      "metres_of_degrees",
      [](double east, double north, double latitude) {
        const Spacing metres = degrees_in_metres({east, north}, latitude);
        return std::pair(metres.x, metres.y);
      },
      py::arg("east"), py::arg("north"), py::arg("latitude"));
  module.def(
      "read_sky",
      [](const std::filesystem::path& path) {
        SkyLight sky;
        {
          const py::gil_scoped_release release;
          sky = load_sky_light(path, default_memory(default_threads()));
        }
        return take_vectors(sky.radiance);
      },
      py::arg("path"));
}

}  // namespace heightlight
