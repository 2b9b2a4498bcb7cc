#pragma once

#include <pybind11/numpy.h>

#include <vector>

#include "heightlight/image.h"

namespace heightlight {

namespace py = pybind11;

/// An array argument from Python. It is converted where its type or layout differs, else read in place.
template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// An array that takes over the vector's content without a copy.
template <class T>
py::array_t<T> take_array(std::vector<T> values, std::vector<py::ssize_t> shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<T>*>(vector); });
  return py::array_t<T>(std::move(shape), kept->data(), owner);
}

/// A NumPy array (height, width) of float32.
inline py::array_t<float> take_map(Map map) {
  return take_array(std::move(map.values), {map.height, map.width});
}

/// A NumPy array (height, width, 3) of float32.
py::array_t<float> take_vectors(const Image<Vector3>& vectors);

/// A NumPy array (height, width) of float64; NaN where `present` is NaN.
py::array_t<double> take_texels(TexelVector values, const Map& present);

/// Throws UsageError, naming the quantity, unless the array has the shape (height, width).
void check_shape(const py::array& array, const std::string& quantity, int height, int width);

/// The values texel by texel, with NaN replaced by 0.
TexelVector read_texels(const Array<double>& array);

}  // namespace heightlight
