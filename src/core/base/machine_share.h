#pragma once

#include <cstdint>
#include <optional>

// What a program that shares its machine with others may take, where nobody says. Linux only.

namespace heightlight {

/// Bytes of memory that this process holds now, its code and libraries included (its resident set).
std::uint64_t resident_memory();

/// Bytes that this process may take beside what it holds already: four fifths of what the kernel says is
/// available, or, where that is less, of what its control groups leave, or of what its limits of addresses
/// and of data (RLIMIT_AS, RLIMIT_DATA) leave beside the stacks of `threads` threads.
std::uint64_t default_memory(int threads);

/// Threads to use: as many as OMP_NUM_THREADS says; or else one per processor that this process may run on,
/// but no more than its control groups' quota of time keeps busy, rounded up, and than whose stacks take a
/// quarter of the addresses that RLIMIT_AS leaves.
int default_threads();

/// The first number of OMP_NUM_THREADS ("4", "4,2"); nothing where it is absent, or none.
std::optional<int> parse_thread_setting(const char* text);

}  // namespace heightlight
