#include "python/arrays.h"

#include <cmath>
#include <string>

#include "heightlight/error.h"

namespace heightlight {

py::array_t<float> take_vectors(const Image<Vector3>& vectors) {
  std::vector<float> values;
  values.reserve(3 * vectors.size());
  for (const Vector3& vector : vectors.values) values.insert(values.end(), {vector.x, vector.y, vector.z});
  return take_array(std::move(values), {vectors.height, vectors.width, 3});
}

py::array_t<double> take_texels(TexelVector values, const Map& present) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(present.values[i])) values[i] = std::nan("");
  }
  return take_array(std::move(values), {present.height, present.width});
}

void check_shape(const py::array& array, const std::string& quantity, int height, int width) {
  if (array.ndim() == 2 && array.shape(0) == height && array.shape(1) == width) return;
  std::string shape;
  for (py::ssize_t i = 0; i < array.ndim(); ++i)
    shape += (i > 0 ? " × " : "") + std::to_string(array.shape(i));
  throw UsageError(quantity, "",
                   "has the shape " + (shape.empty() ? "of one number" : shape) + ", the map " +
                       std::to_string(height) + " × " + std::to_string(width));
}

TexelVector read_texels(const Array<double>& array) {
  TexelVector values(array.data(), array.data() + array.size());
  for (double& value : values) {
    if (std::isnan(value)) value = 0;
  }
  return values;
}

}  // namespace heightlight
