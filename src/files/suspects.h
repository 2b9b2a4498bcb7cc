#pragma once

#include "files/stored_heights.h"

namespace heightlight {

/// Checks whether the lowest or the highest samples are far from all others, as values are that stand for
/// missing samples or come from faulty sensors. Gives one warning for each, with the option that would make
/// them missing.
std::vector<Warning> find_suspects(const StoredHeights& stored);

}  // namespace heightlight
