#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace heightlight {

/// Four bytes, the highest first.
inline std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
  return bytes;
}

/// A PNG chunk (PNG specification, 5.3), with its checksum, or with a wrong one.
inline std::string png_chunk(const std::string& type, const std::string& data, bool right_sum = true) {
  const std::string summed = type + data;
  const auto sum = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size())));
  return big_endian(static_cast<std::uint32_t>(data.size())) + summed + big_endian(right_sum ? sum : sum ^ 1);
}

inline std::string deflated(const std::string& data) {
  std::string out(compressBound(data.size()), '\0');
  uLongf size = out.size();
  compress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
           data.size());
  out.resize(size);
  return out;
}

constexpr const char* kPngSignature = "\x89PNG\r\n\x1a\n";

/// So many zero bytes, deflated piece by piece.
inline std::string deflated_zeros(std::size_t count) {
  z_stream state{};
  deflateInit(&state, Z_DEFAULT_COMPRESSION);
  std::string zeros(1 << 16, '\0');
  std::string piece(1 << 16, '\0');
  std::string out;
  for (int result = Z_OK; result != Z_STREAM_END;) {
    state.next_in = reinterpret_cast<Bytef*>(zeros.data());
    const std::size_t taken = std::min(count, zeros.size());
    state.avail_in = static_cast<uInt>(taken);
    count -= taken;
    do {
      state.next_out = reinterpret_cast<Bytef*>(piece.data());
      state.avail_out = static_cast<uInt>(piece.size());
      result = deflate(&state, count == 0 ? Z_FINISH : Z_NO_FLUSH);
      out.append(piece, 0, piece.size() - state.avail_out);
    } while (state.avail_out == 0);
  }
  deflateEnd(&state);
  return out;
}

/// Header of 8-bit samples: colour type 0 grey, 2 RGB, 4 grey and alpha.
inline std::string png_header(std::uint32_t width, std::uint32_t height, int colour_type = 0) {
  return png_chunk("IHDR", big_endian(width) + big_endian(height) + '\x08' + static_cast<char>(colour_type) +
                               std::string(3, '\0'));
}

/// 2 × 2 grey samples 10, 20, 30, 40, with more chunks before them.
inline std::string small_png(const std::string& more = "") {
  return kPngSignature + png_header(2, 2) + more +
         png_chunk("IDAT", deflated(std::string("\0\x0a\x14\0\x1e\x28", 6))) + png_chunk("IEND", "");
}

}  // namespace heightlight
