#pragma once

#include <pybind11/numpy.h>

#include <vector>

#include "heightlight/image.h"

namespace heightlight {

namespace py = pybind11;

/// What Python gives as numbers: converted where it has another type or layout, else read where it lies.
template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// An array that owns what the vector held, without a copy.
template <class T>
py::array_t<T> take_array(std::vector<T> values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return py::array_t<T>(std::move(shape), kept->data(), owner);
}

/// (height, width) of float32.
inline py::array_t<float> take_map(Map map) {
  return take_array(std::move(map.values), {map.height, map.width});
}

/// (height, width, 3) of float32.
py::array_t<float> take_vectors(const Image<Vector3>& vectors);

/// (height, width) of float64; NaN where `present` is NaN.
py::array_t<double> take_texels(TexelVector values, const Map& present);

/// Throws UsageError, naming the quantity, unless the array has that shape.
void check_shape(const py::array& array, const std::string& quantity, int height, int width);

/// Texel by texel, NaN as 0.
TexelVector read_texels(const Array<double>& array);

}  // namespace heightlight
