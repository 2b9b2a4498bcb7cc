#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace heightlight {

/// Text as HTML shows it, between tags and in quoted attributes. What printable() (files/printable.h)
/// replaces by '?' is replaced here too; line breaks and tabs stay.
std::string html_text(const std::string& text);

/// JSON that can stand between <script> tags: no '<' is in it. Bytes that are no UTF-8 are replaced.
std::string script_json(const nlohmann::ordered_json& json);

}  // namespace heightlight
