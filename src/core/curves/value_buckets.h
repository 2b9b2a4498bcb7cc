#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace heightlight {

/// A range of values cut into 256 equal coarse buckets, and each of these into 256 fine ones.
class ValueBuckets {
 public:
  static constexpr std::uint32_t kCoarse = 256;
  static constexpr std::uint32_t kFine = 256;  ///< in a coarse one

  /// Where the range is nothing, or too small to divide by (1e-303), all values are in bucket 0.
  ValueBuckets(double least, double greatest)
      : least_(least),
        greatest_(greatest),
        per_unit_(std::min(kSpan / (greatest - least), std::numeric_limits<double>::max())) {}

  /// The fine bucket of a value in the range, coarse × 256 + fine; it never falls as values rise.
  std::uint16_t bucket(double value) const {
    return static_cast<std::uint16_t>((value - least_) * per_unit_);
  }

  /// The value `part` of the way, in [0, 1], through a fine bucket.
  double value(std::uint32_t bucket, double part) const {
    return std::min(greatest_, least_ + (bucket + part) / kSpan * (greatest_ - least_));
  }

 private:
  /// All buckets, less what keeps the greatest value in the last one when products are rounded.
  static constexpr double kSpan = kCoarse * kFine - 1e-9;

  double least_;
  double greatest_;
  double per_unit_;
};

}  // namespace heightlight
