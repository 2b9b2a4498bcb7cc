#include <pybind11/stl.h>

#include "python/arrays.h"
#include "python/bindings.h"
#include "python/python_watch.h"

namespace heightlight {
namespace {

/// (height, width, 5): of x² − y², xy, z², xz, yz.
py::array_t<float> take_second(const Image<std::array<float, 5>>& moments) {
  std::vector<float> values;
  values.reserve(5 * moments.size());
  for (const std::array<float, 5>& five : moments.values)
    values.insert(values.end(), five.begin(), five.end());
  return take_array(std::move(values), {moments.height, moments.width, 5});
}

py::array_t<float> take_horizons(const std::vector<Map>& horizons, const Surface& surface) {
  std::vector<float> values;
  values.reserve(horizons.size() * surface.map.height.size());
  for (const Map& horizon : horizons)
    values.insert(values.end(), horizon.values.begin(), horizon.values.end());
  return take_array(std::move(values),
                    {static_cast<py::ssize_t>(horizons.size()), surface.height(), surface.width()});
}

/// What is wanted of the sky beside α and A.
struct SkyParts {
  bool shares = true;
  bool moments = false;
  std::vector<double> horizon_rad = {};
};

py::dict find_sky(const Surface& surface, const Settings& settings, const SkyParts& parts,
                  std::optional<double> reach, const std::string& falloff) {
  Request request = make_request(settings);
  request.wanted.sky = parts.shares;
  request.wanted.moments = {.first = parts.moments, .second = parts.moments};
  request.wanted.horizon_rad = parts.horizon_rad;
  if (reach) request.wanted.reach = Reach{.distance = *reach, .falloff = falloff_named(falloff)};
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
  if (!parts.horizon_rad.empty()) found["horizons"] = take_horizons(results.horizons, surface);
  found["evidence"] = evidence_text(results.evidence);
  return found;
}

}  // namespace

void add_sky(py::module_& module) {
  module.def(
      "sky",
      [](const Surface& surface, const Settings& settings, bool moments, std::optional<double> reach,
         const std::string& falloff) {
        return find_sky(surface, settings, {.moments = moments}, reach, falloff);
      },
      py::arg("surface"), py::arg("settings"), py::arg("moments"), py::arg("reach"), py::arg("falloff"));
  module.def(
      "horizons",
      [](const Surface& surface, const Settings& settings, const std::vector<double>& azimuths,
         std::optional<double> reach, const std::string& falloff) {
        return find_sky(surface, settings, {.shares = false, .horizon_rad = azimuths}, reach, falloff);
      },
      py::arg("surface"), py::arg("settings"), py::arg("azimuths"), py::arg("reach"), py::arg("falloff"));
}

}  // namespace heightlight
