#pragma once

#include <cstdint>
#include <optional>

// What a program that shares its machine with others may take unless its user says otherwise. Linux only.

namespace heightlight {

/// Bytes of memory that this process holds now, its code and libraries included (its resident set).
std::uint64_t resident_memory();

/// Bytes that this process may take beside what it holds already: four fifths of the least of three amounts.
/// They are what the kernel says is available, what the process's control groups leave, and what its limits
/// of addresses and of data (RLIMIT_AS, RLIMIT_DATA) leave beside the stacks of `threads` threads.
std::uint64_t default_memory(int threads);

/// Number of threads to use. It is what OMP_NUM_THREADS says, if that is set. Otherwise it is one per
/// processor that this process may run on, but no more than the control groups' quota of time keeps busy,
/// rounded up, and no more than those whose stacks take a quarter of the addresses that RLIMIT_AS leaves.
int default_threads();

/// The first number of OMP_NUM_THREADS ("4", "4,2"); nothing where the text is absent or holds no positive
/// number.
std::optional<int> parse_thread_setting(const char* text);

}  // namespace heightlight
