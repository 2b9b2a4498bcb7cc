#include "cli/memory_promise.h"

#include <algorithm>
#include <string>

#include "base/byte_size.h"

namespace heightlight {

MemoryError with_program(const MemoryError& error, const RunOptions& run) {
  constexpr std::uint64_t kFromRunToRun = 4 << 20;  // what the program itself takes varies by
  const std::uint64_t enough = run.program_memory + run.memory + error.missing + kFromRunToRun;
  return {error.what() + (", in addition to the " + format_byte_size(run.program_memory)) +
              " that the program itself takes",
          error.missing, write_enough(enough)};
}

std::uint64_t memory_beside(const RunOptions& run, const Surface& surface) {
  const std::uint64_t held = surface.map.height.size() * (sizeof(float) + sizeof(Vector3));
  return run.memory - std::min(run.memory, held);
}

}  // namespace heightlight
