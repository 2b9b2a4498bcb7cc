#include "cli/user_message.h"

#include <algorithm>
#include <new>

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

std::string user_message(const std::exception& error) {
  if (const auto* known = dynamic_cast<const Error*>(&error)) return user_message(*known);
  if (dynamic_cast<const std::bad_alloc*>(&error)) return "out of memory";
  return error.what();
}

}  // namespace heightlight
