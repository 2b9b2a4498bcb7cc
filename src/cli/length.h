#pragma once

#include <optional>
#include <string>

namespace heightlight {

/// A length as users write it.
struct Length {
  double value = 0;       ///< world units; metres where it has a unit
  bool has_unit = false;  ///< mm, cm, m, km, in or ft
};

/// "0.05", "5cm", "1.5 m"; nothing for anything else. A length with a unit makes world units metres.
std::optional<Length> read_length(const std::string& text);

}  // namespace heightlight
