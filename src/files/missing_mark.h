#pragma once

#include <optional>
#include <string>

#include "files/image_file.h"

namespace heightlight {

/// What stands for missing samples in a file of floats.
struct MissingMark {
  float value = 0;
  std::string text;  ///< in a file of text
};

/// That of the place's no-data tag; nothing where it has none that is a number.
std::optional<MissingMark> missing_mark_of(const TextureLayout& layout);

/// NaN becomes the mark. Samples that are so near to it by chance that a program may take them for it (GDAL
/// does up to 4 units of single precision, 4.8e-7 of the value) move just beyond, upward.
float mark_missing(const MissingMark& mark, float sample);

}  // namespace heightlight
