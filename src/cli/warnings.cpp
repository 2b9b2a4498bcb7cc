#include "cli/warnings.h"

#include <fmt/core.h>

#include "cli/tell.h"
#include "cli/user_message.h"
#include "files/printable.h"

namespace heightlight {

std::string user_message(const Warning& warning) {
  return user_message(Error(warning.message, warning.remedy));
}

void tell_warnings(const std::filesystem::path& map, const std::vector<Warning>& warnings) {
  for (const Warning& warning : warnings) {
    tell("warning: " + map.string() + ": " + user_message(warning));
  }
}

void report_removed(const std::vector<std::string>& names) {
  if (names.empty()) return;
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  fmt::print("removed files of an earlier result that this one does not have: {}\n", printable(list));
}

}  // namespace heightlight
