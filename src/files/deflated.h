#pragma once

#include <string>

namespace heightlight {

/// Compresses the bytes into a zlib stream (RFC 1950).
std::string deflate_bytes(const std::string& bytes);

}  // namespace heightlight
