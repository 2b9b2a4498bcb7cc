#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "visibility/field_levels.h"

namespace heightlight {

/// A field on the surface, over square blocks of 2^l × 2^l samples, as walks read it. Every level has a
/// margin on all sides that holds what lies beyond the map's edges, so that readers need not check for edges.
class FieldPyramid {
 public:
  struct Level {
    int first_row = 0;  ///< block row of the map at row 0; 0 except in windows of a larger map
    int first_column = 0;
    int width = 0;  ///< blocks, without the margin
    int height = 0;
    int margin = 0;
    std::vector<float> values;

    std::ptrdiff_t stride() const { return width + 2 * std::ptrdiff_t{margin}; }
    /// Address of the block in row 0 and column 0.
    const float* origin() const { return values.data() + margin * stride() + margin; }
    float* origin() { return values.data() + margin * stride() + margin; }
    /// Address of a block, by its row and column in the map.
    const float* block(int row, int column) const {
      return values.data() + (row - first_row + margin) * stride() + (column - first_column + margin);
    }
  };

  /// `levels`: number of levels above the samples themselves; `margin`: blocks beyond the map's edges that
  /// readers may touch.
  FieldPyramid(const Surface& surface, int levels, int margin);

  /// Fills all levels from values per sample, which are NaN where the sample is missing. Each block is the
  /// mean of its parts. Missing samples take the value of the block around them, or 0 where no level has a
  /// value. Beyond the edges of a map that does not tile, the outermost value is repeated; nothing is ever
  /// seen there.
  void fill(const Map& values);

  /// Fills level l alone from a height per block. NaN becomes kNoHeight, and so does what lies beyond the
  /// edges of a map that does not tile.
  void fill_heights(int l, const Map& heights);

  /// Fills level l alone of a window's pyramid from `values`, which include the margin and have no gaps.
  void take_level(int l, Map values);

  /// Number of levels, with the samples' own.
  int levels() const { return static_cast<int>(levels_.size()); }
  const Level& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }

 private:
  FieldView view(std::size_t l);
  void fill_margins(std::size_t l, const float* outside);

  const Surface& surface_;
  std::vector<Level> levels_;
};

/// Number of levels above the samples up to the level of a single block: enough to fill holes of any size.
int levels_to_one(int width, int height);

/// Bytes of the pyramid of a map of that size.
std::uint64_t field_pyramid_bytes(int width, int height, int levels, int margin);

}  // namespace heightlight
