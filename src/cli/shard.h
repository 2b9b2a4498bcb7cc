#pragma once

#include <cstdint>
#include <string>

namespace heightlight {

/// One of the shares into which the runs of a dataset are divided by their keys: the same share for every
/// process that is given the same runs, which need not know each other.
struct Shard {
  std::uint64_t number = 1;  ///< from 1 to `count`
  std::uint64_t count = 1;
};

/// Reads "K/N". Throws UsageError, naming the option, unless 1 ≤ K ≤ N.
Shard parse_shard(const std::string& text);

/// Whether a run of this key (SHA-256, hexadecimal) belongs to the shard. A run without a key, whose input
/// cannot be read, belongs to every one.
bool has_run(const Shard& shard, const std::string& key);

}  // namespace heightlight
