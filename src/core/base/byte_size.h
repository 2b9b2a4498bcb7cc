#pragma once

#include <cstdint>
#include <string>

namespace heightlight {

/// Number of bytes meant by "8G", "512M", "64k", "1.5GiB" or a plain number; units are powers of 1024. Throws
/// UsageError for any other text.
std::uint64_t parse_byte_size(const std::string& text);

/// Writes a number of bytes like "1.5 GiB", for messages.
std::string format_byte_size(std::uint64_t bytes);

/// Writes a number of bytes like "412M", rounded up to whole mebibytes; parse_byte_size reads it.
std::string write_enough(std::uint64_t bytes);

/// Largest number of bytes that this process has held so far (its resident set); 0 where there is no /proc.
std::uint64_t peak_memory();

}  // namespace heightlight
