#include "cli/warnings.h"

#include <fmt/core.h>

#include <cstdio>

#include "cli/user_message.h"
#include "files/printable.h"

namespace heightlight {

std::string user_message(const Warning& warning) {
  return user_message(Error(warning.message, warning.remedy));
}

void tell_warnings(const std::filesystem::path& map, const std::vector<Warning>& warnings) {
  for (const Warning& warning : warnings) {
    fmt::print(stderr, "heightlight: warning: {}: {}\n", printable(map), printable(user_message(warning)));
  }
}

}  // namespace heightlight
