#include "cli/user_message.h"

#include <algorithm>

namespace heightlight {
namespace {

/// "max_distance" is the option --max-distance.
std::string option_of(std::string quantity) {
  std::replace(quantity.begin(), quantity.end(), '_', '-');
  return "--" + quantity;
}

}  // namespace

std::string user_message(const Error& error) {
  std::string message = error.what();
  if (const auto* usage = dynamic_cast<const UsageError*>(&error); usage && !usage->quantity.empty()) {
    message = option_of(usage->quantity) + message.substr(usage->quantity.size());
  }
  if (!error.remedy.empty()) message += " (" + option_of(error.remedy) + ")";
  return message;
}

}  // namespace heightlight
