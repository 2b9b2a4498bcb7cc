#include "cli/tell.h"

#include <cstdio>

#include "files/printable.h"

namespace heightlight {

void tell(const std::string& line) { std::fputs(("heightlight: " + printable(line) + "\n").c_str(), stderr); }

}  // namespace heightlight
