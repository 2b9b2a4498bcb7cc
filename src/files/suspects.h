#pragma once

#include "files/stored_heights.h"

namespace heightlight {

/// Whether the lowest or the highest samples are far from all others, as values are that stand for missing
/// samples or come from faulty sensors: one warning each, with the option that would make them go missing.
std::vector<Warning> find_suspects(const StoredHeights& stored);

}  // namespace heightlight
