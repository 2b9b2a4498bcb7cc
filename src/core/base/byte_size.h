#pragma once

#include <cstdint>
#include <string>

namespace heightlight {

/// Bytes meant by "8G", "512M", "64k", "1.5GiB" or a plain number; powers of 1024. Throws UsageError
/// otherwise.
std::uint64_t parse_byte_size(const std::string& text);

/// "1.5 GiB", for messages.
std::string format_byte_size(std::uint64_t bytes);

/// Bytes of memory that the machine can still give, by the kernel's own estimate, within the process's own
/// limit (RLIMIT_AS).
std::uint64_t available_memory();

/// Largest number of bytes that this process has held so far (its resident set).
std::uint64_t peak_memory();

}  // namespace heightlight
