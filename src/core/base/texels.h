#pragma once

#include "base/parallel.h"
#include "heightlight/image.h"

namespace heightlight {

/// Calls body(i) once for the index of each sample of an image, in any order, on all threads.
template <class T, class Body>
void for_texels(const Image<T>& image, Body&& body) {
  parallel_for(image.height, [&](std::int64_t row) {
    const std::size_t begin = image.index(static_cast<int>(row), 0);
    for (std::size_t i = begin; i < begin + static_cast<std::size_t>(image.width); ++i) body(i);
  });
}

}  // namespace heightlight
