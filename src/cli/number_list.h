#pragma once

#include <optional>
#include <string>
#include <vector>

namespace heightlight {

/// "135,30" as finite numbers; nothing where the text is no such list.
std::optional<std::vector<double>> parse_number_list(const std::string& text);

}  // namespace heightlight
