#include "files/projection_text.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>

namespace heightlight {
namespace {

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// What stands in the quotation marks behind a place; empty where none do.
std::string quoted_behind(const std::string& text, std::size_t at) {
  const std::size_t begin = text.find('"', at);
  const std::size_t end = begin == std::string::npos ? begin : text.find('"', begin + 1);
  return end == std::string::npos ? "" : text.substr(begin + 1, end - begin - 1);
}

/// Of the whole system the code comes last, behind all that it is made of: AUTHORITY["EPSG","32631"]] or
/// ID["EPSG",32631]].
std::string epsg_code(const std::string& text) {
  const std::size_t at = text.rfind("\"EPSG\",");
  if (at == std::string::npos) return "";
  std::string code = text.substr(at + 7);
  std::erase(code, '"');
  const std::size_t digits = std::min(code.find_first_not_of("0123456789"), code.size());
  const bool is_last = code.find_first_not_of("] \t", digits) == std::string::npos;
  return digits > 0 && is_last ? "EPSG:" + code.substr(0, digits) : "";
}

/// UNIT["metre",1.0] or LENGTHUNIT["metre",1]: the projected system's comes behind those of its parts.
std::optional<double> last_unit(const std::string& upper) {
  const std::size_t at = upper.rfind("UNIT[\"");
  const std::size_t comma = at == std::string::npos ? at : upper.find("\",", at);
  if (comma == std::string::npos) return std::nullopt;
  const double metres = std::strtod(upper.c_str() + comma + 2, nullptr);
  return metres > 0 ? std::optional(metres) : std::nullopt;
}

void note_well_known_text(const std::string& text, const std::string& upper, Georeference& place) {
  place.in_degrees =
      upper.starts_with("GEOGCS") || upper.starts_with("GEOGCRS") || upper.starts_with("GEODCRS");
  if (!place.in_degrees) place.metres = last_unit(upper);
  place.system = epsg_code(text);
  if (place.system.empty()) place.system = quoted_behind(text, 0);
}

void note_keywords(const std::string& upper, Georeference& place) {
  const std::size_t at = upper.find("UNITS");
  if (at == std::string::npos) return;
  const std::size_t begin = std::min(upper.find_first_not_of(" \t", at + 5), upper.size());
  const std::string unit = upper.substr(begin, upper.find_first_of(" \t", begin) - begin);
  place.in_degrees = unit == "DD";
  if (unit == "METERS" || unit == "METRES") place.metres = 1;
  if (unit == "FEET") place.metres = 0.3048;
}

}  // namespace

std::string read_projection_text(const std::filesystem::path& grid) {
  constexpr std::size_t kLargest = 1 << 16;
  for (const char* extension : {".prj", ".PRJ"}) {
    std::filesystem::path path = grid;
    path.replace_extension(extension);
    std::error_code failure;
    const auto size = std::filesystem::file_size(path, failure);
    if (failure || size > kLargest) continue;
    std::ifstream stream(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
  }
  return "";
}

void note_projection(const std::string& text, Georeference& place) {
  place.projection = text;
  const std::string upper = upper_case(text);
  const bool is_well_known =
      upper.starts_with("GEOGC") || upper.starts_with("GEODC") || upper.starts_with("PROJC");
  if (is_well_known) {
    note_well_known_text(text, upper, place);
  } else {
    note_keywords(upper, place);
  }
}

}  // namespace heightlight
