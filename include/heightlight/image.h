#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace heightlight {

/// A rectangle of samples, row-major; row 0 is the image's top. `width` and `height` count samples.
template <class T>
struct Image {
  int width = 0;
  int height = 0;
  std::vector<T> values;

  Image() = default;
  Image(int columns, int rows, T value = T{})
      : width(columns),
        height(rows),
        values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), value) {}

  std::size_t size() const { return values.size(); }
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  }
  T& operator()(int row, int column) { return values[index(row, column)]; }
  const T& operator()(int row, int column) const { return values[index(row, column)]; }

  friend bool operator==(const Image&, const Image&) = default;
};

/// One value per texel; NaN marks a texel without an answer (a missing sample).
using Map = Image<float>;

}  // namespace heightlight
