#include "files/geo_keys.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "files/projection_text.h"

namespace heightlight {
namespace {

constexpr std::uint16_t kText = 2;
constexpr std::uint16_t kShort = 3;
constexpr std::uint16_t kDouble = 12;

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

template <class T>
std::vector<T> values_of(const GeoTag& tag, std::uint16_t type) {
  if (tag.type != type) return {};
  std::vector<T> values(tag.bytes.size() / sizeof(T));
  std::memcpy(values.data(), tag.bytes.data(), values.size() * sizeof(T));
  return values;
}

// Numbers of the keys that are used here, and their values.
constexpr std::uint16_t kModelType = 1024;
constexpr std::uint16_t kRasterType = 1025;
constexpr std::uint16_t kGeodeticSystem = 2048;
constexpr std::uint16_t kAngularUnit = 2054;
constexpr std::uint16_t kSemiMajorAxis = 2057;
constexpr std::uint16_t kProjectedSystem = 3072;
constexpr std::uint16_t kProjectedCitation = 3073;
constexpr std::uint16_t kLinearUnit = 3076;
constexpr std::uint16_t kLinearUnitSize = 3077;
constexpr std::uint16_t kVerticalSystem = 4096;
constexpr std::uint16_t kVerticalUnit = 4099;
constexpr std::uint16_t kProjected = 1;
constexpr std::uint16_t kGeographic = 2;
constexpr std::uint16_t kCells = 1;
constexpr std::uint16_t kPoints = 2;
constexpr std::uint16_t kUserDefined = 32767;
constexpr std::uint16_t kMetre = 9001;
constexpr std::uint16_t kDegree = 9102;
constexpr std::string_view kCitationBegin = "ESRI PE String = ";

/// Values of the keys by number. They are stored in the directory itself, among the doubles, or in the text.
struct KeyValues {
  std::map<std::uint16_t, std::uint16_t> shorts;
  std::map<std::uint16_t, double> doubles;
  std::map<std::uint16_t, std::string> texts;

  std::optional<std::uint16_t> find(std::uint16_t key) const {
    const auto found = shorts.find(key);
    return found == shorts.end() ? std::nullopt : std::optional(found->second);
  }
};

/// Reads the directory: a header of four shorts (version, revision, minor revision, number of keys), then
/// four shorts for each key: its number, the tag that holds its value (0: the directory itself), the count,
/// and the value or its offset.
std::optional<KeyValues> list_keys(const std::vector<std::uint16_t>& words,
                                   const std::vector<double>& parameters, const std::string& text) {
  KeyValues values;
  if (words.size() < 4 || words[0] != 1 || words.size() < 4 + 4 * std::size_t{words[3]}) return std::nullopt;
  for (std::size_t i = 0; i < words[3]; ++i) {
    const std::uint16_t* key = words.data() + 4 + 4 * i;
    bool is_new = true;
    if (key[1] == 0) {
      is_new = values.shorts.emplace(key[0], key[3]).second;
    } else if (key[1] == kDoubleParametersTag) {
      if (key[3] >= parameters.size()) return std::nullopt;
      is_new = values.doubles.emplace(key[0], parameters[key[3]]).second;
    } else if (key[1] == kTextParametersTag) {
      if (std::size_t{key[3]} + key[2] > text.size()) return std::nullopt;
      is_new = values.texts.emplace(key[0], text.substr(key[3], key[2])).second;
    }
    if (!is_new) return std::nullopt;
  }
  return values;
}

/// Length in metres of a unit of length, by its code in the EPSG register; empty for an unknown unit.
std::optional<double> metres_of_unit(std::uint16_t code) {
  switch (code) {
    case kMetre:
      return 1;
    case 9002:
      return 0.3048;
    case 9003:
      return 1200.0 / 3937;  // US survey foot
    case 9036:
      return 1000;
    default:
      return std::nullopt;
  }
}

/// Whether the unit of a projected system is the metre: UTM zones (WGS 84, ETRS 89, NAD 83, WGS 72), and the
/// systems of the continents and countries whose terrain is published most.
bool has_metres(std::uint16_t code) {
  constexpr std::array<std::array<std::uint16_t, 2>, 6> kZones{
      {{32601, 32660}, {32701, 32760}, {25828, 25838}, {26901, 26923}, {32201, 32260}, {32301, 32360}}};
  constexpr std::array<std::uint16_t, 18> kSystems{2056, 2154, 2157, 2180, 2193, 3006, 3031,  3034,  3035,
                                                   3067, 3395, 3413, 3857, 5070, 5514, 21781, 27700, 28992};
  return std::any_of(kZones.begin(), kZones.end(),
                     [&](const auto& zone) { return code >= zone[0] && code <= zone[1]; }) ||
         std::find(kSystems.begin(), kSystems.end(), code) != kSystems.end();
}

/// Length of the unit in metres of vertical systems in feet: NGVD 29, NAVD 88, and those of the Cayman
/// Islands.
std::optional<double> metres_of_vertical(std::uint16_t code) {
  switch (code) {
    case 5702:
    case 6360:
      return 1200.0 / 3937;
    case 8228:
    case 6130:
    case 6131:
    case 6132:
      return 0.3048;
    default:
      return std::nullopt;
  }
}

std::string epsg(const std::optional<std::uint16_t>& code) {
  return code && *code != kUserDefined ? "EPSG:" + std::to_string(*code) : "";
}

/// The name of a unit in a message; a unit that the file itself defines has no code.
std::string name_unit(std::uint16_t code) {
  return code == kUserDefined ? "one of the file's own" : epsg(code);
}

void read_projected(const KeyValues& values, GeoKeys& keys, std::string& fault) {
  const std::optional<std::uint16_t> system = values.find(kProjectedSystem);
  const std::optional<std::uint16_t> unit = values.find(kLinearUnit);
  keys.system = epsg(system);
  if (unit && *unit != kUserDefined) {
    keys.metres = metres_of_unit(*unit);
    if (!keys.metres) fault = "its unit of length, " + name_unit(*unit) + ", is not known";
  } else if (const auto size = values.doubles.find(kLinearUnitSize); size != values.doubles.end()) {
    keys.metres = size->second;
    if (!(*keys.metres > 0) || !std::isfinite(*keys.metres)) fault = "its unit of length is no length";
  } else if (system && has_metres(*system)) {
    keys.metres = 1;
  } else {
    fault = "it does not tell its unit of length";
  }
}

void read_geographic(const KeyValues& values, GeoKeys& keys, std::string& fault) {
  constexpr std::uint16_t kSupplierDegree = 9122;
  const std::uint16_t unit = values.find(kAngularUnit).value_or(kDegree);
  keys.in_degrees = true;
  keys.system = epsg(values.find(kGeodeticSystem));
  if (unit != kDegree && unit != kSupplierDegree)
    fault = "its angles are in a unit that is not known, " + name_unit(unit);
  if (const auto axis = values.doubles.find(kSemiMajorAxis); axis != values.doubles.end())
    keys.equator_radius = axis->second;
}

/// Reads a system that is given as text, as Esri's programs and GDAL write and read it.
void read_citation(std::string text, GeoKeys& keys, std::string& fault) {
  if (!text.starts_with(kCitationBegin)) {
    fault = "it does not tell whether its coordinates are lengths or degrees";
    return;
  }
  Georeference told;
  note_projection(text.substr(kCitationBegin.size(), text.find('|') - kCitationBegin.size()), told);
  keys.in_degrees = told.in_degrees;
  keys.metres = told.metres;
  keys.equator_radius = told.equator_radius;
  if (!keys.height_metres) keys.height_metres = told.height_metres;
  keys.system = told.system;
  keys.projection = told.projection;
  if (!keys.in_degrees && !keys.metres) fault = "it does not tell its unit of length";
}

/// The unit of heights in GDAL's metadata on bands, where they give it.
std::optional<double> unit_in_metadata(const std::string& text) {
  const std::string unit = metadata_in_role(text, "unittype");
  if (unit == "m" || unit == "metre" || unit == "meter" || unit == "metres" || unit == "meters") return 1;
  if (unit == "ft" || unit == "foot" || unit == "feet") return 0.3048;
  if (unit == "us-ft" || unit == "US survey foot") return 1200.0 / 3937;
  return std::nullopt;
}

/// Makes a directory of keys, in rising order, and the text to which the citation key refers.
std::vector<GeoTag> key_tags(const std::vector<std::array<std::uint16_t, 2>>& shorts,
                             const std::string& citation) {
  std::vector<std::uint16_t> words{1, 1, 0, 0};
  for (const auto& [key, value] : shorts) words.insert(words.end(), {key, 0, 1, value});
  if (!citation.empty()) {
    words.insert(words.end(), {kProjectedCitation, kTextParametersTag,
                               static_cast<std::uint16_t>(citation.size() + 1), 0});
  }
  words[3] = static_cast<std::uint16_t>(words.size() / 4 - 1);
  std::vector<GeoTag> tags{make_tag(kKeyDirectoryTag, words)};
  if (!citation.empty()) tags.push_back(make_tag(kTextParametersTag, citation + '|'));
  return tags;
}

}  // namespace

GeoTag make_tag(std::uint16_t number, const std::vector<double>& values) {
  return {number, kDouble, bytes_of(values)};
}

GeoTag make_tag(std::uint16_t number, const std::vector<std::uint16_t>& values) {
  return {number, kShort, bytes_of(values)};
}

GeoTag make_tag(std::uint16_t number, const std::string& text) { return {number, kText, text + '\0'}; }

std::vector<double> doubles_of(const GeoTag& tag) { return values_of<double>(tag, kDouble); }

std::vector<std::uint16_t> shorts_of(const GeoTag& tag) { return values_of<std::uint16_t>(tag, kShort); }

std::string text_of(const GeoTag& tag) {
  return tag.type == kText ? tag.bytes.substr(0, tag.bytes.find('\0')) : "";
}

std::string metadata_in_role(const std::string& metadata, const std::string& role) {
  const std::string begin = "role=\"" + role + "\">";
  const std::size_t at = metadata.find(begin);
  if (at == std::string::npos) return "";
  const std::string rest = metadata.substr(at + begin.size());
  return rest.substr(0, rest.find('<'));
}

const GeoTag* find_tag(const std::vector<GeoTag>& tags, std::uint16_t number) {
  const auto found =
      std::find_if(tags.begin(), tags.end(), [number](const GeoTag& tag) { return tag.number == number; });
  return found == tags.end() ? nullptr : &*found;
}

GeoKeys read_geo_keys(const std::vector<GeoTag>& tags, std::string& fault) {
  GeoKeys keys;
  const GeoTag* metadata = find_tag(tags, kGdalMetadataTag);
  if (metadata) keys.height_metres = unit_in_metadata(text_of(*metadata));
  const GeoTag* directory = find_tag(tags, kKeyDirectoryTag);
  if (!directory) return keys;
  keys.present = true;
  const GeoTag* parameters = find_tag(tags, kDoubleParametersTag);
  const GeoTag* text = find_tag(tags, kTextParametersTag);
  const std::optional<KeyValues> values =
      list_keys(shorts_of(*directory), parameters ? doubles_of(*parameters) : std::vector<double>{},
                text ? text_of(*text) : "");
  if (!values) {
    fault = "its directory of GeoTIFF keys is damaged";
    return keys;
  }
  keys.point_samples = values->find(kRasterType) == kPoints;
  const std::optional<std::uint16_t> model = values->find(kModelType);
  if (model == kProjected) {
    read_projected(*values, keys, fault);
  } else if (model == kGeographic) {
    read_geographic(*values, keys, fault);
  } else if (model == kUserDefined && values->texts.contains(kProjectedCitation)) {
    read_citation(values->texts.at(kProjectedCitation), keys, fault);
  } else {
    fault = "it does not tell whether its coordinates are lengths or degrees";
  }
  if (const auto unit = values->find(kVerticalUnit)) {
    keys.height_metres = metres_of_unit(*unit);
    if (!keys.height_metres) fault = "its unit of heights, " + name_unit(*unit) + ", is not known";
  } else if (const auto system = values->find(kVerticalSystem); system && !keys.height_metres) {
    keys.height_metres = metres_of_vertical(*system);
  }
  return keys;
}

std::vector<GeoTag> make_geo_tags(const Georeference& place) {
  if (!place.corner) return {};
  std::vector<GeoTag> tags{
      make_tag(kPixelScaleTag, std::vector<double>{place.cell.x, place.cell.y, 0}),
      make_tag(kTiePointTag, std::vector<double>{0, 0, 0, (*place.corner)[0], (*place.corner)[1], 0})};
  std::vector<GeoTag> keys;
  // Keys have 16 bits, so a code of six digits can only be given in the text.
  std::uint16_t code = 0;
  const bool has_code =
      place.system.starts_with("EPSG:") && (place.in_degrees || place.metres == 1.0) &&
      std::from_chars(place.system.data() + 5, place.system.data() + place.system.size(), code).ec ==
          std::errc();
  if (has_code) {
    const auto model = place.in_degrees ? kGeographic : kProjected;
    const auto system = place.in_degrees ? kGeodeticSystem : kProjectedSystem;
    const auto unit = place.in_degrees ? kAngularUnit : kLinearUnit;
    keys = key_tags({{kModelType, model},
                     {kRasterType, kCells},
                     {system, code},
                     {unit, place.in_degrees ? kDegree : kMetre}},
                    "");
  } else if (!place.projection.empty()) {
    keys = key_tags({{kModelType, kUserDefined}, {kRasterType, kCells}},
                    std::string(kCitationBegin) + place.projection);
  }
  tags.insert(tags.end(), keys.begin(), keys.end());
  return tags;
}

}  // namespace heightlight
