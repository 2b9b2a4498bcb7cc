#pragma once

#include <cstdint>

#include "bake/bake.h"

namespace heightlight {

/// Bytes that light, albedo and channels of one's own, and local maps, take beside the solution.
std::uint64_t bytes_beside_solution(int width, int height, const BakeOptions& options);

/// Bytes that baking takes at its worst moment, on so many threads as there are now: while the solution is
/// found, or while its maps are written. Of an albedo only the number of channels counts, and whether it
/// varies.
std::uint64_t bake_bytes(int width, int height, const BakeOptions& options);

}  // namespace heightlight
