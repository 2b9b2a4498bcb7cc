#include "bake/bake.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>

#include "bake/baked_map.h"
#include "bake/material.h"
#include "base/parallel.h"
#include "heightlight/error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/python_watch.h"

namespace heightlight {
namespace {

TextureDepth depth_named(const std::string& name, TextureFormat format) {
  if (name.empty()) return format == TextureFormat::png ? TextureDepth::uint16 : TextureDepth::real;
  if (name == "8") return TextureDepth::uint8;
  if (name == "16") return TextureDepth::uint16;
  if (name == "half") return TextureDepth::half;
  if (name == "float") return TextureDepth::real;
  throw UsageError("depth", name, "must be 8, 16, half or float");
}

}  // namespace

MaterialMap map_named(const std::string& name) {
  std::string known;
  for (const MaterialMapName& entry : material_maps()) {
    if (name == entry.name) return entry.map;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UsageError("maps", "", "'" + name + "' is no map (known: " + known + ")");
}

void set_format(const std::string& format, const std::string& depth, BakeOptions& options) {
  if (format != "png" && format != "exr" && format != "tif")
    throw UsageError("format", format, "must be png, exr or tif");
  options.format = format == "png"   ? TextureFormat::png
                   : format == "exr" ? TextureFormat::exr
                                     : TextureFormat::tif;
  options.depth = depth_named(depth, options.format);
}

BakeOptions read_bake_options(const std::vector<std::string>& maps, const py::dict& choice,
                              const Settings& settings) {
  BakeOptions options;
  for (const std::string& name : maps) options.maps.push_back(map_named(name));
  options.albedo = {.constant = choice["albedo"].cast<std::vector<double>>()};
  if (!choice["max_distance"].is_none())
    options.maximum_distance =
        MaximumDistance{.distance = choice["max_distance"].cast<double>(),
                        .falloff = falloff_named(choice["falloff"].cast<std::string>())};
  options.uniform_ao = choice["uniform_ao"].cast<bool>();
  options.y_down = choice["y_down"].cast<bool>();
  options.horizon_azimuths = choice["horizon_azimuths"].cast<int>();
  if (choice.contains("azimuth_convention"))
    options.azimuth_convention = azimuth_convention_named(choice["azimuth_convention"].cast<std::string>());
  options.below = below_horizontal_named(choice["below_horizontal"].cast<std::string>());
  if (choice.contains("roughness")) options.gloss.roughness = choice["roughness"].cast<double>();
  if (choice.contains("view")) {
    const auto view = choice["view"].cast<std::vector<float>>();
    options.view = {view.at(0), view.at(1), view.at(2)};
  }
  const Request request = make_request(settings);
  if (request.accuracy.visibility == Visibility::rays)
    throw UsageError("rays", "", "bake no maps; leave them out");
  options.error = request.accuracy.error;
  options.azimuths = request.accuracy.azimuths;
  options.seed = request.accuracy.seed;
  options.memory = request.limits.memory;
  return options;
}

namespace {

/// A baked material, whose maps can be read and written.
class Bake {
 public:
  Bake(SharedSurface surface, const Settings& settings, BakeOptions options)
      : surface_(std::move(surface)), options_(std::move(options)) {
    check_bake_options(options_);
    PythonWatch watch(settings.progress);
    material_ = watch.run([&](const Watch& told) {
      const ThreadScope threads(settings.threads);
      options_.watch = told;
      return find_material(*surface_, options_);
    });
    options_.watch = {};
  }
  Bake(const Bake&) = delete;
  Bake& operator=(const Bake&) = delete;

  /// The map as an array (height, width), or (height, width, channels) if there are several channels.
  py::array_t<float> map(const std::string& name) const {
    const MaterialMap wanted = map_named(name);
    if (!is_wanted(options_, wanted)) throw UsageError("maps", "", "'" + name + "' was not asked for");
    const std::vector<BakedChannel> channels = baked_channels(wanted, material_, options_);
    std::vector<float> values(channels.size() * surface_->map.height.size());
    {
      const py::gil_scoped_release release;
      parallel_for(surface_->height(), [&](std::int64_t row) {
        const std::size_t begin = surface_->map.height.index(static_cast<int>(row), 0);
        for (std::size_t i = begin; i < begin + static_cast<std::size_t>(surface_->width()); ++i) {
          for (std::size_t c = 0; c < channels.size(); ++c)
            values[i * channels.size() + c] = channels[c].value(i);
        }
      });
    }
    std::vector<py::ssize_t> shape{surface_->height(), surface_->width()};
    if (channels.size() > 1) shape.push_back(static_cast<py::ssize_t>(channels.size()));
    return take_array(std::move(values), std::move(shape));
  }

  /// Writes the maps as the command does; returns the names of the files.
  std::vector<std::string> save(const std::filesystem::path& folder, const std::string& name,
                                const std::string& format, const std::string& depth) const {
    BakeOptions options = options_;
    set_format(format, depth, options);
    SourceFacts facts;
    facts.format = "array";
    facts.sample_type = "float";
    const py::gil_scoped_release release;
    write_material(material_, {.facts = facts, .place = {}}, options,
                   {.source = name, .inputs = {}, .folder = folder, .name = name});
    return baked_files(name, options);
  }

  std::string evidence() const { return evidence_text(material_.results.evidence); }

 private:
  SharedSurface surface_;
  BakeOptions options_;
  Material material_;
};

}  // namespace

void add_bake(py::module_& module) {
  py::class_<Bake>(module, "Bake")
      .def(py::init([](const std::shared_ptr<Surface>& surface, const Settings& settings,
                       const std::vector<std::string>& maps, const py::dict& choice) {
             return std::make_unique<Bake>(surface, settings, read_bake_options(maps, choice, settings));
           }),
           py::arg("surface"), py::arg("settings"), py::arg("maps"), py::arg("choice"))
      .def("map", &Bake::map, py::arg("name"))
      .def("save", &Bake::save, py::arg("folder"), py::arg("name"), py::arg("format"), py::arg("depth"))
      .def_property_readonly("evidence", &Bake::evidence);
  module.def("material_maps", [] {
    py::dict maps;
    for (const MaterialMapName& map : material_maps()) maps[map.name] = map.description;
    return maps;
  });
}

}  // namespace heightlight
