#pragma once

namespace heightlight {

/// So many threads, and no more, for the libraries that read and write pictures: they would take one per
/// processor of the machine.
void limit_library_threads(int threads);

}  // namespace heightlight
