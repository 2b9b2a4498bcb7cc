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

MaterialMap map_named(const std::string& name) {
  std::string known;
  for (const MaterialMapName& entry : material_maps()) {
    if (name == entry.name) return entry.map;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw UsageError("maps", "", "'" + name + "' is no map (known: " + known + ")");
}

/// What Python chooses beside the maps and the settings.
struct BakeChoice {
  std::vector<double> albedo = {0.5};
  std::optional<double> reach = {};
  std::string falloff = "none";
  bool uniform_ao = false;
  bool y_down = false;
  int horizon_azimuths = 4;
  std::optional<AzimuthConvention> convention = {};
  BelowHorizontal below = BelowHorizontal::sky;
};

/// A material that was found, and may be written.
class Bake {
 public:
  Bake(SharedSurface surface, const Settings& settings, const std::vector<std::string>& maps,
       const BakeChoice& choice)
      : surface_(std::move(surface)) {
    for (const std::string& name : maps) options_.maps.push_back(map_named(name));
    options_.albedo = {.constant = choice.albedo};
    if (choice.reach)
      options_.reach = Reach{.distance = *choice.reach, .falloff = falloff_named(choice.falloff)};
    options_.uniform_ao = choice.uniform_ao;
    options_.y_down = choice.y_down;
    options_.horizon_azimuths = choice.horizon_azimuths;
    options_.azimuth_convention = choice.convention;
    options_.below = choice.below;
    const Request request = make_request(settings);
    options_.error = request.accuracy.error;
    options_.azimuths = request.accuracy.azimuths;
    options_.seed = request.accuracy.seed;
    options_.memory = request.limits.memory;
    if (request.accuracy.visibility == Visibility::rays)
      throw UsageError("rays", "", "bake no maps; leave them out");
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

  /// (height, width), or (height, width, channels) where there are more than one.
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

  /// Writes the maps as the command does; names of the files.
  std::vector<std::string> save(const std::filesystem::path& folder, const std::string& name,
                                const std::string& format, const std::string& depth) const {
    BakeOptions options = options_;
    options.format = format == "png"   ? TextureFormat::png
                     : format == "exr" ? TextureFormat::exr
                                       : TextureFormat::tif;
    if (format != "png" && format != "exr" && format != "tif")
      throw UsageError("format", format, "must be png, exr or tif");
    options.depth = depth_named(depth, options.format);
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
  static TextureDepth depth_named(const std::string& name, TextureFormat format) {
    if (name.empty()) return format == TextureFormat::png ? TextureDepth::uint16 : TextureDepth::real;
    if (name == "8") return TextureDepth::uint8;
    if (name == "16") return TextureDepth::uint16;
    if (name == "half") return TextureDepth::half;
    if (name == "float") return TextureDepth::real;
    throw UsageError("depth", name, "must be 8, 16, half or float");
  }

  SharedSurface surface_;
  BakeOptions options_;
  Material material_;
};

}  // namespace

void add_bake(py::module_& module) {
  py::class_<Bake>(module, "Bake")
      .def(py::init([](const std::shared_ptr<Surface>& surface, const Settings& settings,
                       const std::vector<std::string>& maps, const py::dict& choice) {
             std::optional<AzimuthConvention> convention;
             if (choice.contains("azimuth_convention"))
               convention = azimuth_convention_named(choice["azimuth_convention"].cast<std::string>());
             return std::make_unique<Bake>(
                 surface, settings, maps,
                 BakeChoice{.albedo = choice["albedo"].cast<std::vector<double>>(),
                            .reach = choice["reach"].cast<std::optional<double>>(),
                            .falloff = choice["falloff"].cast<std::string>(),
                            .uniform_ao = choice["uniform_ao"].cast<bool>(),
                            .y_down = choice["y_down"].cast<bool>(),
                            .horizon_azimuths = choice["horizon_azimuths"].cast<int>(),
                            .convention = convention,
                            .below = below_horizontal_named(choice["below_horizontal"].cast<std::string>())});
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
