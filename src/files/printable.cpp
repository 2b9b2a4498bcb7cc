#include "files/printable.h"

#include <cstdint>
#include <string_view>

namespace heightlight {
namespace {

/// The UTF-8 sequence at the beginning of a text (RFC 3629): its length in bytes and its code point. Where
/// there is no valid sequence, it is one byte and U+FFFF.
struct Sequence {
  std::size_t bytes = 1;
  std::uint32_t code = 0xffff;
};

Sequence first_sequence(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {1, lead};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return {};
    code = code << 6 | (byte(i) & 0x3fu);
  }
  if (code < kLeast[bytes] || code > 0x10ffff) return {};
  return {bytes, code};
}

/// Whether a code point may be printed. Not printable: C0 and C1 controls, line and paragraph separators,
/// marks that change the direction of writing, surrogates, and code points that are not characters.
bool is_printable(std::uint32_t code) {
  const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029;
  const bool turns = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  const bool no_character = (code >= 0xd800 && code < 0xe000) || (code & 0xfffe) == 0xfffe;
  return !control && !turns && !no_character;
}

}  // namespace

std::string printable(const std::string& whole) {
  std::string_view text = whole;
  std::string result;
  while (!text.empty()) {
    const Sequence first = first_sequence(text);
    result += is_printable(first.code) ? std::string(text.substr(0, first.bytes)) : "?";
    text.remove_prefix(first.bytes);
  }
  return result;
}

bool is_utf8(const std::string& text) {
  constexpr std::uint32_t kNone = Sequence{}.code;
  for (std::string_view rest = text; !rest.empty();) {
    const Sequence first = first_sequence(rest);
    if (first.bytes == 1 && first.code == kNone) return false;
    rest.remove_prefix(first.bytes);
  }
  return true;
}

}  // namespace heightlight
