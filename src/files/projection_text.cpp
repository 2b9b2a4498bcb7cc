#include "files/projection_text.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <system_error>

namespace heightlight {
namespace {

const std::set<std::string> kProjectionWords{"PROJECTION", "DATUM", "ZONE", "UNITS", "ZUNITS", "YSHIFT"};

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The quoted text that follows position `at`; empty if there is none.
std::string quoted_behind(const std::string& text, std::size_t at) {
  const std::size_t begin = text.find('"', at);
  const std::size_t end = begin == std::string::npos ? begin : text.find('"', begin + 1);
  return end == std::string::npos ? "" : text.substr(begin + 1, end - begin - 1);
}

/// The EPSG code of the whole system, which comes last, after those of its components:
/// AUTHORITY["EPSG","32631"]] or ID["EPSG",32631]].
std::string epsg_code(const std::string& text) {
  const std::size_t at = text.rfind("\"EPSG\",");
  if (at == std::string::npos) return "";
  std::string code = text.substr(at + 7);
  std::erase(code, '"');
  const std::size_t digits = std::min(code.find_first_not_of("0123456789"), code.size());
  const bool is_last = code.find_first_not_of("] \t", digits) == std::string::npos;
  return digits > 0 && is_last ? "EPSG:" + code.substr(0, digits) : "";
}

/// The number after the name in the last bracket of that keyword: UNIT["metre",1.0].
std::optional<double> last_number(const std::string& upper, const std::string& keyword) {
  const std::size_t at = upper.rfind(keyword + "[\"");
  const std::size_t comma = at == std::string::npos ? at : upper.find("\",", at);
  if (comma == std::string::npos) return std::nullopt;
  const double number = std::strtod(upper.c_str() + comma + 2, nullptr);
  return number > 0 ? std::optional(number) : std::nullopt;
}

/// The text of the first bracket that follows one of these keywords, including the keyword and the closing
/// bracket.
std::string first_node(const std::string& text, const std::string& upper,
                       std::initializer_list<const char*> keywords) {
  std::size_t begin = std::string::npos;
  for (const std::string keyword : keywords) begin = std::min(begin, upper.find(keyword + "["));
  if (begin == std::string::npos) return "";
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = begin; i < text.size(); ++i) {
    if (text[i] == '"') quoted = !quoted;
    if (quoted) continue;
    depth += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
    if (text[i] == ']' && depth == 0) return text.substr(begin, i + 1 - begin);
  }
  return text.substr(begin);
}

/// Reads well-known text. Returns false if it names no horizontal system.
bool note_well_known_text(const std::string& text, Georeference& place) {
  const std::string all = upper_case(text);
  const std::string system = first_node(
      text, all,
      {"PROJCS", "PROJCRS", "PROJECTEDCRS", "GEOGCS", "GEOGCRS", "GEODCRS", "GEOGRAPHICCRS", "GEODETICCRS"});
  if (system.empty()) return false;
  const std::string upper = upper_case(system);
  place.in_degrees = upper.starts_with("GEO");
  if (!place.in_degrees) place.metres = last_number(upper, "UNIT");
  place.equator_radius =
      last_number(upper, upper.find("SPHEROID[") < upper.size() ? "SPHEROID" : "ELLIPSOID");
  place.system = epsg_code(system);
  if (place.system.empty()) place.system = quoted_behind(system, 0);
  const std::string vertical = first_node(text, all, {"VERTCS", "VERT_CS", "VERTCRS", "VERTICALCRS"});
  if (!vertical.empty()) place.height_metres = last_number(upper_case(vertical), "UNIT");
  return true;
}

/// Reads the older list of keywords. EPSG codes are known for degrees and for the northern UTM zones, on WGS
/// 84.
void note_keywords(const std::string& upper, Georeference& place) {
  const auto metres_named = [](const std::string& unit) {
    return unit == "METERS" || unit == "METRES" ? std::optional(1.0)
           : unit == "FEET"                     ? std::optional(0.3048)
                                                : std::nullopt;
  };
  std::map<std::string, std::string> said;
  std::istringstream words(upper);
  for (std::string word, value; words >> word;) {
    if (kProjectionWords.contains(word) && words >> value) said.emplace(word, value);
  }
  place.in_degrees = said["UNITS"] == "DD";
  place.metres = metres_named(said["UNITS"]);
  place.height_metres = metres_named(said["ZUNITS"]);
  if (said["DATUM"] != "WGS84" && said["DATUM"] != "WGS_1984") return;
  const double zone = std::strtod(said["ZONE"].c_str(), nullptr);
  const bool is_north = std::strtod(said["YSHIFT"].c_str(), nullptr) == 0;
  if (place.in_degrees && said["PROJECTION"] == "GEOGRAPHIC") {
    place.system = "EPSG:4326";
  } else if (place.metres == 1.0 && said["PROJECTION"] == "UTM" && is_north && zone >= 1 && zone <= 60) {
    place.system = "EPSG:" + std::to_string(32600 + static_cast<int>(zone));
  }
}

/// Replaces control characters, including line breaks, by blanks, and removes trailing blanks.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
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
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  return "";
}

void note_projection(const std::string& text, Georeference& place) {
  place.projection = on_one_line(text);
  if (!note_well_known_text(place.projection, place)) note_keywords(upper_case(place.projection), place);
}

}  // namespace heightlight
