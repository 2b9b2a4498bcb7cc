#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heightlight {

/// A rectangle of samples, row-major; row 0 is the image's top. `width` and `height` count samples.
template <class T>
struct Image {
  using value_type = T;

  int width = 0;
  int height = 0;
  std::vector<T> values;

  /// Makes an empty image.
  Image() = default;
  /// Makes an image whose samples are all `value`. Both sides are ≥ 0.
  Image(int columns, int rows, T value = T{})
      : width(columns),
        height(rows),
        values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}

  /// Returns the number of samples.
  std::size_t size() const { return values.size(); }
  /// Returns the place in `values` of the sample at a row and a column; neither is checked.
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
  T& operator()(int row, int column) { return values[index(row, column)]; }
  const T& operator()(int row, int column) const { return values[index(row, column)]; }

  friend bool operator==(const Image&, const Image&) = default;
};

/// A vector in world axes: x right, y up the image, z out of it.
struct Vector3 {
  float x = 0;
  float y = 0;
  float z = 0;

  friend bool operator==(const Vector3&, const Vector3&) = default;
};

/// One value per texel; NaN marks a texel without an answer (a missing sample).
using Map = Image<float>;

/// One value per texel in row-major order, in the precision that sums are made with; 0 where the sample is
/// missing.
using TexelVector = std::vector<double>;

}  // namespace heightlight
