#pragma once

#include <filesystem>

#include "heightlight/error.h"

namespace heightlight {

/// What work() returns; what it throws for want of memory gets the name of the map before it.
template <class Work>
auto name_errors(const std::filesystem::path& map, Work&& work) {
  try {
    return work();
  } catch (const MemoryError& error) {
    throw MemoryError(map.string() + ": " + error.what(), error.missing);
  }
}

}  // namespace heightlight
