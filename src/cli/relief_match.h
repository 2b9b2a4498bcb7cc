#pragma once

#include <string>

#include "cli/bake_command.h"

namespace heightlight {

/// The relief at which a map has the normals or the occlusion of --match, as the command is to load it then:
/// with `load.relief` and `relief_from`. Tells what was found, on stdout unless it is to be quiet, and what
/// speaks against it, on stderr. Throws Error naming a file that cannot be read, or is of another shape.
BakeCommand with_matched_relief(const BakeCommand& command, const BakeInput& input);

}  // namespace heightlight
