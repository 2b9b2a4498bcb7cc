#pragma once

namespace heightlight {

/// Limits the libraries that read and write pictures to so many threads. Otherwise they would start one per
/// processor of the machine.
void limit_library_threads(int threads);

}  // namespace heightlight
