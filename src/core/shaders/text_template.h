#pragma once

#include <string>
#include <utility>
#include <vector>

namespace heightlight {

/// Pairs of a name and the text that replaces $name.
using Replacements = std::vector<std::pair<std::string, std::string>>;

/// Returns the text with each $name in it replaced. A $name without a replacement is removed.
std::string fill_in(const std::string& text, const Replacements& replacements);

}  // namespace heightlight
