#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "visibility/field_levels.h"

namespace heightlight {

/// A field on the surface, over square blocks of 2^l × 2^l samples, as walks read it. Every level has a
/// margin on all sides that holds what lies beyond the map's edges, so that reading needs no care.
class FieldPyramid {
 public:
  struct Level {
    int first_row = 0;  ///< block of the map that row 0 is; not 0 in windows of a larger map alone
    int first_column = 0;
    int width = 0;  ///< blocks, without the margin
    int height = 0;
    int margin = 0;
    std::vector<float> values;

    std::ptrdiff_t stride() const { return width + 2 * std::ptrdiff_t{margin}; }
    /// Of the block in row 0 and column 0.
    const float* origin() const { return values.data() + margin * stride() + margin; }
    float* origin() { return values.data() + margin * stride() + margin; }
    /// Of a block by its place in the map.
    const float* block(int row, int column) const {
      return values.data() + (row - first_row + margin) * stride() + (column - first_column + margin);
    }
  };

  /// `levels` above the samples themselves; `margin`: blocks beyond the map's edges that reading may touch.
  FieldPyramid(const Surface& surface, int levels, int margin);

  /// From values per sample, those of missing ones NaN: each block is the mean of its parts, and missing
  /// samples take the value of the block around them, 0 where no level has any. Beyond the edges of a map
  /// that does not tile nothing is ever seen, and the outermost value stands.
  void fill(const Map& values);

  /// Level l alone, from a value per block, kNoHeight beyond the edges of a map that does not tile.
  void fill_heights(int l, const Map& heights);

  /// Level l alone of a window's pyramid, margin included, from values that are there everywhere.
  void take_level(int l, Map values);

  /// The samples' among them.
  int levels() const { return static_cast<int>(levels_.size()); }
  const Level& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }

 private:
  FieldView view(std::size_t l);
  void fill_margins(std::size_t l, const float* outside);

  const Surface& surface_;
  std::vector<Level> levels_;
};

/// Levels above the samples up to that of one block: as many as holes of any size want.
int levels_to_one(int width, int height);

/// Bytes that a pyramid of such a map takes.
std::uint64_t field_pyramid_bytes(int width, int height, int levels, int margin);

}  // namespace heightlight
