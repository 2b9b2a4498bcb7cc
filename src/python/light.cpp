#include <pybind11/stl.h>

#include <numbers>

#include "base/parallel.h"
#include "heightlight/sky_light.h"
#include "heightlight/sun.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/python_watch.h"

namespace heightlight {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

/// E₀/π of the sun. Azimuth (clockwise from north), elevation and diameter are in degrees.
py::array_t<double> find_sun(const Surface& surface, const Settings& settings, double azimuth,
                             double elevation, double diameter) {
  const Sun sun{.azimuth_rad = std::numbers::pi / 2 - azimuth * kDegree,
                .elevation_rad = elevation * kDegree,
                .diameter_rad = diameter * kDegree};
  PythonWatch watch(settings.progress);
  TexelVector found = watch.run([&](const Watch& told) {
    const ThreadScope threads(settings.threads);
    return sun_irradiance(surface, sun, told);
  });
  return take_texels(std::move(found), surface.map.height);
}

SkyLight read_radiance(const Array<float>& radiance) {
  if (radiance.ndim() != 3 || radiance.shape(2) != 3)
    throw UsageError("sky", "", "must be overcast, or radiance: (rows, 2 rows, 3)");
  SkyLight sky{Image<Vector3>(static_cast<int>(radiance.shape(1)), static_cast<int>(radiance.shape(0)))};
  const float* value = radiance.data();
  for (Vector3& texel : sky.radiance.values) {
    texel = {value[0], value[1], value[2]};
    value += 3;
  }
  return sky;
}

/// (E₀/π per channel, number of azimuths, RMSE) of the overcast sky, or of a sky given by its radiance.
py::tuple find_sky_light(const Surface& surface, const Settings& settings,
                         const std::optional<Array<float>>& radiance) {
  const SkyLight sky = radiance ? read_radiance(*radiance) : overcast_sky();
  PythonWatch watch(settings.progress);
  SkyIrradiance found = watch.run([&](const Watch& told) {
    const ThreadScope threads(settings.threads);
    return sky_irradiance(
        surface, sky,
        {.error = settings.error, .azimuths = settings.azimuths, .seed = settings.seed, .watch = told});
  });
  py::list channels;
  for (TexelVector& channel : found.channels)
    channels.append(take_texels(std::move(channel), surface.map.height));
  return py::make_tuple(channels, found.azimuths, found.rmse);
}

}  // namespace

void add_light(py::module_& module) {
  module.def("sun_irradiance", find_sun, py::arg("surface"), py::arg("settings"), py::arg("azimuth"),
             py::arg("elevation"), py::arg("diameter"));
  module.def("sky_irradiance", find_sky_light, py::arg("surface"), py::arg("settings"), py::arg("radiance"));
}

}  // namespace heightlight
