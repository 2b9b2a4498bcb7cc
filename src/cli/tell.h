#pragma once

#include <string>

namespace heightlight {

/// One line on stderr, "heightlight: …". What cannot be written there is nobody's to tell.
void tell(const std::string& line);

}  // namespace heightlight
