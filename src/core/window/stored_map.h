#pragma once

#include <cstdint>

namespace heightlight {

/// A rectangle of samples or blocks. In the coordinates of a map it may go on beyond the map's edges.
struct MapRect {
  int first_row = 0;
  int first_column = 0;
  int rows = 0;
  int columns = 0;

  std::int64_t count() const { return std::int64_t{rows} * columns; }
  friend bool operator==(const MapRect&, const MapRect&) = default;
};

/// A map of floats that lies somewhere else, since memory may not hold it.
class StoredMap {
 public:
  virtual ~StoredMap() = default;
  virtual int width() const = 0;
  virtual int height() const = 0;
  /// Copies a rectangle of it, which lies inside, row by row. May be called from many threads.
  virtual void read(const MapRect& rect, float* samples) const = 0;
};

}  // namespace heightlight
