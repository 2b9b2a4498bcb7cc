#pragma once

#include <cstdint>
#include <string>

namespace heightlight {

/// Bytes meant by "8G", "512M", "64k", "1.5GiB" or a plain number; powers of 1024. Throws UsageError
/// otherwise.
std::uint64_t parse_byte_size(const std::string& text);

/// "1.5 GiB", for messages.
std::string format_byte_size(std::uint64_t bytes);

/// "412M": no less than that many bytes, in whole mebibytes, as parse_byte_size reads it.
std::string write_enough(std::uint64_t bytes);

/// Largest number of bytes that this process has held so far (its resident set); 0 where /proc is not there.
std::uint64_t peak_memory();

}  // namespace heightlight
