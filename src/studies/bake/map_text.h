#pragma once

#include <string>

#include "bake/bake.h"

namespace heightlight {

/// What the files of a map say it is: its definition, in ASCII.
std::string map_text(MaterialMap map, const BakeOptions& options);

}  // namespace heightlight
