#pragma once

#include <cmath>
#include <cstdint>

namespace heightlight {

/// A sum that does not depend on the order of its terms: each term is rounded down to a multiple of 2^−63,
/// and whole numbers add up exactly. Terms and sum must be below 2^62 in absolute value.
class FixedSum {
 public:
  FixedSum() = default;
  /// From the values that whole() and part() return.
  FixedSum(std::int64_t whole, std::uint64_t part) : whole_(whole), part_(part) {}

  void add(double term) {
    const double floor = std::floor(term);
    add({static_cast<std::int64_t>(floor), static_cast<std::uint64_t>(std::ldexp(term - floor, 63)) << 1});
  }
  void add(const FixedSum& other) {
    part_ += other.part_;
    whole_ += other.whole_ + (part_ < other.part_ ? 1 : 0);
  }

  double value() const { return static_cast<double>(whole_) + std::ldexp(static_cast<double>(part_), -64); }

  std::int64_t whole() const { return whole_; }
  std::uint64_t part() const { return part_; }  ///< in units of 2^−64; always even

  friend bool operator==(const FixedSum&, const FixedSum&) = default;

 private:
  std::int64_t whole_ = 0;
  std::uint64_t part_ = 0;
};

}  // namespace heightlight
