#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>

#include "report/page.h"

namespace heightlight {

/// A group as the page's script reads it: names, and each picture's levels (pack_levels). Nothing where these
/// alone have more bytes than `limit`.
std::optional<nlohmann::ordered_json> describe_group(const PictureGroup& group, std::size_t limit);

/// A chart likewise; y is null where a line breaks.
nlohmann::ordered_json describe_chart(const PageChart& chart);

}  // namespace heightlight
