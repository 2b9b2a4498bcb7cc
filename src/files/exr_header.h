#pragma once

#include "files/input_file.h"

namespace heightlight {

/// Walks over the attributes of an OpenEXR file's headers ("OpenEXR File Layout", Header Attributes) before
/// the library does, which would take the memory that each announces. Throws Error naming the file for an
/// attribute that announces more than the file holds, and for headers that are cut short.
void check_exr_headers(const InputFile& file);

}  // namespace heightlight
