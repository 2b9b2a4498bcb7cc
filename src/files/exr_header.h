#pragma once

#include "files/input_file.h"

namespace heightlight {

/// Checks the attributes of an OpenEXR file's headers ("OpenEXR File Layout", Header Attributes) before the
/// library reads them, because the library allocates whatever size an attribute announces. Throws Error
/// naming the file for an attribute that announces more bytes than the file holds, and for truncated headers.
void check_exr_headers(const InputFile& file);

}  // namespace heightlight
