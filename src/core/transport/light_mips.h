#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/transport.h"

namespace heightlight {

/// One level of a field over square blocks of samples, with a margin on all sides: what lies beyond the map's
/// edges is there already, so that reading needs no care.
struct LightLevel {
  static constexpr int kMargin = 112;  ///< on the left and right; above and below kRowMargin
  static constexpr int kRowMargin = 72;

  int width = 0;  ///< blocks, without margins
  int height = 0;
  std::vector<float> values;

  int stride() const { return width + 2 * kMargin; }
  /// Of the block in row 0 and column 0.
  float* origin() { return values.data() + std::ptrdiff_t{kRowMargin} * stride() + kMargin; }
  const float* origin() const { return values.data() + std::ptrdiff_t{kRowMargin} * stride() + kMargin; }
};

/// A field that is seen from afar, over blocks of 2^l × 2^l samples. What is seen of a block is mostly what
/// stands steep in it: walls hide more of a distant receiver's view than the ground between them. A block's
/// value is therefore the mean of its parts weighted by their steepness, |∇z| + kFlatShare.
class LightMips {
 public:
  /// Up to the level at which a block spans the farthest that walks look.
  explicit LightMips(const Surface& surface);

  /// Fills all levels from values per sample. Missing samples take the value of the blocks around them.
  void fill(const TexelVector& values);

  const LightLevel& level(int l) const { return levels_[static_cast<std::size_t>(l)]; }
  std::uint64_t bytes() const;

 private:
  void fill_margins(int l);
  void fill_holes(int l);

  const Surface& surface_;
  bool has_holes_ = false;
  std::vector<LightLevel> levels_;
  std::vector<Image<std::uint8_t>>
      weights_;  ///< [l]: of the blocks of level l among their siblings; 0 for holes
};

/// Bytes that LightMips takes for a map of that size.
std::uint64_t light_mips_bytes(int width, int height);

/// Weight of level ground, in units of slope.
constexpr float kFlatShare = 0.1F;

}  // namespace heightlight
