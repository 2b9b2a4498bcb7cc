#pragma once

#include <string>
#include <utility>
#include <vector>

namespace heightlight {

/// What stands for each $name.
using Replacements = std::vector<std::pair<std::string, std::string>>;

/// The text with each $name in it replaced. Where no replacement has a name, nothing takes its place.
std::string fill_in(const std::string& text, const Replacements& replacements);

}  // namespace heightlight
