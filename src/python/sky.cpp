#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/python_watch.h"

namespace heightlight {
namespace {

/// An array (height, width, 5) of the moments of x² − y², xy, z², xz, yz.
py::array_t<float> take_second(const Image<std::array<float, 5>>& moments) {
  std::vector<float> values;
  values.reserve(5 * moments.size());
  for (const std::array<float, 5>& five : moments.values)
    values.insert(values.end(), five.begin(), five.end());
  return take_array(std::move(values), {moments.height, moments.width, 5});
}

/// An array (maps, height, width).
py::array_t<float> take_maps(const std::vector<Map>& maps, const Surface& surface) {
  std::vector<float> values;
  values.reserve(maps.size() * surface.map.height.size());
  for (const Map& map : maps) values.insert(values.end(), map.values.begin(), map.values.end());
  return take_array(std::move(values),
                    {static_cast<py::ssize_t>(maps.size()), surface.height(), surface.width()});
}

/// The parts of the sky that are wanted.
struct SkyParts {
  bool shares = true;  ///< α and A
  bool moments = false;
  std::vector<double> horizon_rad = {};
  std::vector<std::string> definitions = {};
};

/// The maximum distance of occluders, their falloff, and what lies below the horizontal, as Python passes
/// them.
struct SkyLimits {
  std::optional<double> maximum_distance;
  std::string falloff;
  std::string below;
};

py::dict find_sky(const Surface& surface, const Settings& settings, const SkyParts& parts,
                  const SkyLimits& limits) {
  Request request = make_request(settings);
  request.wanted.sky = parts.shares;
  request.wanted.moments = {.first = parts.moments, .second = parts.moments};
  request.wanted.horizon_rad = parts.horizon_rad;
  for (const std::string& name : parts.definitions)
    request.wanted.definitions.push_back(sky_definition_named(name));
  if (limits.maximum_distance)
    request.wanted.maximum_distance =
        MaximumDistance{.distance = *limits.maximum_distance, .falloff = falloff_named(limits.falloff)};
  request.wanted.below = below_horizontal_named(limits.below);
  PythonWatch watch(settings.progress);
  Results results = watch.run([&](const Watch& told) {
    request.watch = told;
    return solve(surface, request);
  });
  py::dict found;
  if (parts.shares || parts.moments) {
    found["ambient_occlusion"] = take_map(std::move(results.ambient_occlusion));
    found["sky_view_factor"] = take_map(std::move(results.sky_view_factor));
  }
  if (parts.moments) {
    found["bent_normal"] = take_vectors(bent_normals(results.moments, surface));
    found["first"] = take_vectors(results.moments.first);
    found["second"] = take_second(results.moments.second);
  }
  if (!parts.horizon_rad.empty()) found["horizons"] = take_maps(results.horizons, surface);
  if (!parts.definitions.empty()) found["definitions"] = take_maps(results.definitions, surface);
  found["evidence"] = evidence_text(results.evidence);
  return found;
}

}  // namespace

void add_sky(py::module_& module) {
  module.def(
      "sky",
      [](const Surface& surface, const Settings& settings, bool moments,
         std::optional<double> maximum_distance, const std::string& falloff, const std::string& below) {
        return find_sky(surface, settings, {.moments = moments},
                        {.maximum_distance = maximum_distance, .falloff = falloff, .below = below});
      },
      py::arg("surface"), py::arg("settings"), py::arg("moments"), py::arg("max_distance"),
      py::arg("falloff"), py::arg("below"));
  module.def(
      "horizons",
      [](const Surface& surface, const Settings& settings, const std::vector<double>& azimuths,
         std::optional<double> maximum_distance, const std::string& falloff, const std::string& below) {
        return find_sky(surface, settings, {.shares = false, .horizon_rad = azimuths},
                        {.maximum_distance = maximum_distance, .falloff = falloff, .below = below});
      },
      py::arg("surface"), py::arg("settings"), py::arg("azimuths"), py::arg("max_distance"),
      py::arg("falloff"), py::arg("below"));
  module.def(
      "definitions",
      [](const Surface& surface, const Settings& settings, const std::vector<std::string>& names,
         std::optional<double> maximum_distance, const std::string& falloff, const std::string& below) {
        return find_sky(surface, settings, {.shares = false, .definitions = names},
                        {.maximum_distance = maximum_distance, .falloff = falloff, .below = below});
      },
      py::arg("surface"), py::arg("settings"), py::arg("names"), py::arg("max_distance"), py::arg("falloff"),
      py::arg("below"));
  module.def("sky_definitions", [] {
    py::dict definitions;
    for (const SkyDefinitionFacts& facts : sky_definitions()) definitions[facts.name] = facts.formula;
    return definitions;
  });
}

}  // namespace heightlight
