#pragma once

#include <cstdint>

namespace heightlight {

/// A bijective scramble of 64 bits (the finaliser of SplitMix64): the project's only source of randomness.
constexpr std::uint64_t scramble(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15ULL;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9ULL;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBULL;
  return value ^ (value >> 31);
}

constexpr std::uint64_t hash_combine(std::uint64_t a, std::uint64_t b) { return scramble(a ^ scramble(b)); }

/// Uniform in [0, 1), from the upper 53 bits.
constexpr double unit_real(std::uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1.0p-53; }

}  // namespace heightlight
