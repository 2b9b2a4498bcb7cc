#pragma once

#include "cli/map_options.h"
#include "heightlight/error.h"
#include "heightlight/surface.h"

namespace heightlight {

/// What to say where `run` allows too little: how much the program itself takes, and what would do.
MemoryError with_program(const MemoryError& error, const RunOptions& run);

/// What is left for work beside a surface, in bytes.
std::uint64_t memory_beside(const RunOptions& run, const Surface& surface);

/// What work() returns; what it throws for want of memory names an amount for `--memory` that would do.
template <class Work>
auto keep_promise(const RunOptions& run, Work&& work) {
  try {
    return work();
  } catch (const MemoryError& error) {
    throw with_program(error, run);
  }
}

}  // namespace heightlight
