#include "cli/shard.h"

#include <cassert>
#include <charconv>

#include "heightlight/error.h"

namespace heightlight {

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  bool is_whole = number.ec == std::errc() && number.ptr != end && *number.ptr == '/';
  if (is_whole) {
    const auto count = std::from_chars(number.ptr + 1, end, shard.count);
    is_whole = count.ec == std::errc() && count.ptr == end;
  }
  if (!is_whole || shard.number < 1 || shard.number > shard.count)
    throw UsageError("shard", text, "must be K/N with K from 1 to N");
  return shard;
}

bool has_run(const Shard& shard, const std::string& key) {
  if (key.empty()) return true;
  constexpr std::size_t kShareDigits = 16;  // 64 bits: shares differ in size by chance alone
  assert(key.size() >= kShareDigits);
  std::uint64_t hash = 0;
  std::from_chars(key.data(), key.data() + kShareDigits, hash, 16);
  return hash % shard.count == shard.number - 1;
}

}  // namespace heightlight
