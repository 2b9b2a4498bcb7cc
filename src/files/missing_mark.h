#pragma once

#include <optional>
#include <string>

#include "files/image_file.h"

namespace heightlight {

/// The value that stands for missing samples in a file of floats.
struct MissingMark {
  float value = 0;
  std::string text;  ///< the same value, as written in a text file
};

/// The no-data value of the layout's georeference; empty if it has none that is a number.
std::optional<MissingMark> missing_mark_of(const TextureLayout& layout);

/// Replaces NaN by the mark. A sample that happens to be so near to the mark that a program may take it for
/// missing (GDAL does up to 4 units of single precision, 4.8e-7 of the value) is moved just beyond that
/// range, upward.
float mark_missing(const MissingMark& mark, float sample);

}  // namespace heightlight
