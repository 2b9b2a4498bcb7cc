#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "heightlight/error.h"
#include "heightlight/synth.h"
#include "python/arrays.h"
#include "python/bindings.h"

namespace heightlight {
namespace {

/// Heights above the lowest sample, computed in double precision, so that a small relief on a large offset
/// keeps its digits.
template <class T>
Heightmap read_heights(const Array<T>& heights) {
  if (heights.ndim() != 2)
    throw UsageError("height", "",
                     "has " + std::to_string(heights.ndim()) + " dimensions, and must have two");
  constexpr py::ssize_t kMostSide = 1'000'000;
  if (heights.shape(0) > kMostSide || heights.shape(1) > kMostSide)
    throw UsageError("height", "", "has a side of more than 10^6 samples");
  Heightmap map;
  map.height = Image<float>(static_cast<int>(heights.shape(1)), static_cast<int>(heights.shape(0)));
  const T* samples = heights.data();
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < map.height.size(); ++i) {
    if (std::isinf(samples[i])) throw UsageError("height", "", "has infinite samples; NaN means missing");
    if (!std::isnan(samples[i])) lowest = std::min(lowest, static_cast<double>(samples[i]));
  }
  if (std::isinf(lowest)) throw UsageError("height", "", "has no samples, or all are missing");
  map.base = lowest;
  for (std::size_t i = 0; i < map.height.size(); ++i)
    map.height.values[i] = static_cast<float>(static_cast<double>(samples[i]) - lowest);
  return map;
}

SharedSurface make_surface(const py::array& heights, double texel_x, double texel_y,
                           const std::string& boundary, std::optional<double> curvature) {
  Heightmap map = py::isinstance<py::array_t<float>>(heights) ? read_heights<float>(Array<float>(heights))
                                                              : read_heights<double>(Array<double>(heights));
  map.spacing = {texel_x, texel_y};
  if (boundary != "tile" && boundary != "open")
    throw UsageError("boundary", boundary, "must be tile or open");
  map.boundary = boundary == "tile" ? Boundary::tile : Boundary::open;
  const py::gil_scoped_release release;
  if (curvature) map = curve_heights(std::move(map), *curvature);
  return std::make_shared<const Surface>(build_surface(std::move(map)));
}

py::array_t<float> make_shape(const std::string& shape, int size, std::uint64_t seed) {
  Image<float> heights;
  {
    const py::gil_scoped_release release;
    heights = synthesize(shape, size, seed);
  }
  return take_map(std::move(heights));
}

}  // namespace

void add_surface(py::module_& module) {
  py::class_<Surface, std::shared_ptr<Surface>>(module, "Surface")
      .def(py::init([](const py::array& heights, double texel_x, double texel_y, const std::string& boundary,
                       std::optional<double> curvature) {
             return std::const_pointer_cast<Surface>(
                 make_surface(heights, texel_x, texel_y, boundary, curvature));
           }),
           py::arg("heights"), py::arg("texel_x"), py::arg("texel_y"), py::arg("boundary"),
           py::arg("curvature"))
      .def_property_readonly("width", &Surface::width)
      .def_property_readonly("height", &Surface::height)
      .def_property_readonly("normal", [](const Surface& surface) { return take_vectors(surface.normal); });
  module.def("synth", make_shape, py::arg("shape"), py::arg("size"), py::arg("seed"));
  module.def("shapes", [] {
    py::dict shapes;
    for (const SynthShape& shape : synth_shapes())
      shapes[py::str(shape.name)] = py::make_tuple(shape.description, shape.tiles);
    return shapes;
  });
}

}  // namespace heightlight
