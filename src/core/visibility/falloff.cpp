#include <algorithm>

#include "heightlight/error.h"
#include "heightlight/visibility.h"

namespace heightlight {

const std::vector<std::string>& falloff_names() {
  static const std::vector<std::string> names{"none", "linear", "sqrt", "exponential"};
  return names;
}

Falloff falloff_named(const std::string& name) {
  const std::vector<std::string>& names = falloff_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw UsageError("falloff", name, "must be none, linear, sqrt or exponential");
  return static_cast<Falloff>(found - names.begin());
}

}  // namespace heightlight
