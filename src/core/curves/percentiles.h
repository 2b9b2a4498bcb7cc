#pragma once

#include <vector>

#include "curves/bin_groups.h"
#include "curves/exact_percentiles.h"
#include "curves/moments.h"

namespace heightlight {

/// The percentiles of each filled bin, the same to the last bit for any number of threads: exact in bins of
/// up to 2048 texels; in fuller ones off by at most (greatest − least) / 65536 of the bin's values. `map` has
/// a value per texel, and `moments` are those of its bins; T is float or double.
template <class T>
std::vector<Percentiles> bin_percentiles(const BinGroups& groups, const T* map,
                                         const std::vector<Moments>& moments);

}  // namespace heightlight
